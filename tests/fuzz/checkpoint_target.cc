// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The state of a run behind the checksums of its checkpoint, changed as the input says: refused, or
// restored. A restored run is not continued: behind its checksums a checkpoint is believed.

#include <string>
#include <vector>

#include "tests/fuzz/byte_reader.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/rendered_images.h"

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

SyntheticSequenceOptions Scene() {
  SyntheticSequenceOptions options = RoomOptions();
  options.width = 160;
  options.height = 120;
  return options;
}

Odometry MakeOdometry() {
  static const PinholeCamera camera = SyntheticSequence(Scene()).camera();
  OdometryOptions options;
  options.tracking.keyframes.max_interval = 0.06;  // seconds: every second frame
  return Odometry(options, camera, {});
}

// What a checkpoint has behind its checksums.
struct Checkpoint {
  std::string state;
  std::string objects;
};

Checkpoint RunAndSave() {
  Odometry odometry = MakeOdometry();
  for (const RgbdImage& image : RenderImages(Scene(), 8)) odometry.Process(image);
  ObjectJournal journal;
  BinaryWriter writer(&journal);
  Require(odometry.Save(&writer), "a run can be saved");
  Require(!journal.pending().empty(), "the run has keyframes");
  return {writer.bytes(), journal.pending()};
}

// Writes the bytes of a value over those at a position.
template <typename T>
void Overwrite(size_t at, const T& value, std::string* bytes) {
  const std::string_view source(reinterpret_cast<const char*>(&value), sizeof(value));
  bytes->replace(at, source.size(), source);
}

// Changes one place as the input says. Half of the changes are in the objects.
void Change(ByteReader* input, Checkpoint* checkpoint) {
  std::string* bytes = input->Below(2) == 0 ? &checkpoint->state : &checkpoint->objects;
  const size_t choice = input->Below(7);
  size_t at = input->Byte();
  at = (at << 8 | input->Byte()) << 8;
  at = (at | input->Byte()) % (bytes->size() + 1);
  switch (choice) {
    case 0:
      return Overwrite(at, input->Byte(), bytes);
    case 1:
      return Overwrite(at / 8 * 8, input->Integer(), bytes);
    case 2:
      return Overwrite(at, static_cast<int32_t>(input->Integer()), bytes);
    case 3:
      return Overwrite(at, input->NumberFor(1.0), bytes);
    case 4:
      bytes->erase(at, input->Byte());
      return;
    case 5:
      bytes->insert(at, bytes->substr(at, input->Byte()));
      return;
    default:
      bytes->resize(at);
  }
}

void Restore(const Checkpoint& checkpoint) {
  ObjectJournal journal(checkpoint.objects);
  BinaryReader reader(checkpoint.state, &journal);
  Odometry odometry = MakeOdometry();
  try {
    odometry.Restore(&reader);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string("its ") + error.what());
  }
  reader.Finish();
  journal.FinishLoading();
  journal.Keep(reader.objects());
}

// Made before the first input, whose time is limited.
const Checkpoint valid_checkpoint = RunAndSave();

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  ByteReader input(data, size);
  Checkpoint changed = valid_checkpoint;
  constexpr int kMaxChanges = 8;
  for (int i = 0; i < kMaxChanges && !input.AtEnd(); ++i) Change(&input, &changed);
  Accepts("its ", [&] { Restore(changed); });
  return 0;
}
