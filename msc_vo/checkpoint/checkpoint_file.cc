// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/checkpoint_file.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

constexpr char kMagic[8] = {'m', 's', 'c', '_', 'v', 'o', ' ', 's'};
// Increase it with every change of what is saved.
constexpr uint64_t kFormat = 33;
constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 40;

// The file is this, the state and the contents.
struct Header {
  char magic[8] = {};
  uint64_t format = 0;
  uint64_t state_bytes = 0;
  uint64_t state_checksum = 0;
  uint64_t num_bytes = 0;  // of the contents
  uint64_t checksum = 0;   // of these
};
static_assert(sizeof(Header) == 48, "written as it is in memory");

struct Contents {
  std::string description;
  int32_t journal = 0;
  uint64_t journal_bytes = 0;
  uint64_t journal_checksum = 0;
};

[[noreturn]] void Fail(const std::string& path, const std::string& problem) {
  throw std::runtime_error(path + ": " + problem +
                           "; the run cannot be resumed, start it again without --resume");
}

std::string Counts(std::uintmax_t present, std::uintmax_t expected) {
  return std::to_string(present) + " of " + std::to_string(expected) + " bytes";
}

// Tests that the bytes behind the first `begin` are of this number and checksum.
void CheckBytes(const std::string& path, const std::string& bytes, size_t begin, uint64_t num_bytes,
                uint64_t checksum) {
  const std::string_view rest = std::string_view(bytes).substr(begin);
  if (rest.size() < num_bytes) {
    Fail(path, "is truncated: it has " + Counts(rest.size(), num_bytes));
  }
  if (Checksum(rest.substr(0, num_bytes)) != checksum) {
    Fail(path, "is damaged: its checksum is wrong");
  }
}

// Reads state.bin and removes all but the state from `bytes`.
Contents TakeContents(const std::string& path, std::string* bytes) {
  Header header;
  if (bytes->size() < sizeof(header)) Fail(path, "is truncated");
  std::memcpy(&header, bytes->data(), sizeof(header));
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) Fail(path, "is not a checkpoint");
  if (header.format != kFormat) {
    Fail(path, "has format " + std::to_string(header.format) + ", and this program reads format " +
                   std::to_string(kFormat) + ": it is of another version of msc_vo");
  }
  CheckBytes(path, *bytes, sizeof(header), header.state_bytes, header.state_checksum);
  const size_t contents_begin = sizeof(header) + header.state_bytes;
  CheckBytes(path, *bytes, contents_begin, header.num_bytes, header.checksum);
  if (bytes->size() - contents_begin != header.num_bytes) {
    Fail(path, "is damaged: it is too long");
  }
  Contents contents;
  ObjectJournal none;
  BinaryReader reader(std::string_view(*bytes).substr(contents_begin), &none);
  reader(contents);
  reader.Finish();
  bytes->resize(contents_begin);
  bytes->erase(0, sizeof(header));
  return contents;
}

// The journal as it was when the checkpoint was written; later objects are cut off.
std::string CheckedJournal(const std::string& path, const Contents& contents) {
  const std::string problem = FileProblem(path, kMaxBytes);
  if (!problem.empty()) Fail(path, problem);
  std::string bytes = ReadFile(path, kMaxBytes);
  if (bytes.size() < contents.journal_bytes) {
    Fail(path, "is truncated: it has " + Counts(bytes.size(), contents.journal_bytes));
  }
  bytes.resize(contents.journal_bytes);
  if (Checksum(bytes) != contents.journal_checksum) {
    Fail(path, "is damaged: its checksum is wrong");
  }
  return bytes;
}

ObjectJournal::Sink SinkTo(const std::shared_ptr<GrowingBinary>& file) {
  return [file](uint64_t offset, std::string_view bytes) { file->Write(offset, bytes); };
}

// Number of a journal by its name; 0 if the file is none.
int JournalNumber(const std::string& path) {
  int number = 0;
  int length = 0;
  const std::string name = path.substr(path.rfind('/') + 1);
  if (std::sscanf(name.c_str(), "objects-%9d.bin%n", &number, &length) != 1) return 0;
  return length == static_cast<int>(name.size()) && number > 0 ? number : 0;
}

}  // namespace

CheckpointFile::CheckpointFile(std::string folder) : folder_(std::move(folder)) {}

std::string CheckpointFile::path() const { return folder_ + "/state.bin"; }

std::string CheckpointFile::JournalPath(int number) const {
  return folder_ + "/objects-" + std::to_string(number) + ".bin";
}

bool CheckpointFile::Exists(const std::string& folder) {
  return HasEntry(CheckpointFile(folder).path());
}

CheckpointFile CheckpointFile::Open(const std::string& folder) {
  CheckpointFile file(folder);
  const std::string path = file.path();
  const std::string problem = FileProblem(path, kMaxBytes);
  if (!problem.empty()) Fail(path, problem);
  std::string bytes = ReadFile(path, kMaxBytes);
  Contents contents = TakeContents(path, &bytes);
  file.number_ = contents.journal;
  const std::string journal_path = file.JournalPath(file.number_);
  std::string journal = CheckedJournal(journal_path, contents);
  file.journal_file_ = std::make_shared<GrowingBinary>(journal_path);
  file.journal_file_->Resize(contents.journal_bytes);
  file.journal_ = std::make_unique<ObjectJournal>(std::move(journal), SinkTo(file.journal_file_));
  file.description_ = std::move(contents.description);
  file.state_ = std::move(bytes);
  return file;
}

void CheckpointFile::ReadDescription(const std::function<void(BinaryReader&)>& read) {
  try {
    ObjectJournal none;
    BinaryReader reader(description_, &none);
    read(reader);
    reader.Finish();
  } catch (const std::exception& error) {
    Fail(path(), error.what());
  }
}

void CheckpointFile::ReadState(const std::function<void(BinaryReader&)>& read) {
  try {
    BinaryReader reader(state_, journal_.get());
    read(reader);
    reader.Finish();
    journal_->FinishLoading();
    journal_->Keep(reader.objects());
  } catch (const std::exception& error) {
    Fail(path(), error.what());
  }
  std::string().swap(state_);
}

void CheckpointFile::BeginJournal() {
  int last = number_;
  for (const std::string& entry : ListFolder(folder_)) last = std::max(last, JournalNumber(entry));
  auto file = std::make_shared<GrowingBinary>(JournalPath(last + 1));
  file->Resize(0);
  number_ = last + 1;
  journal_ = std::make_unique<ObjectJournal>(SinkTo(file));
  journal_file_ = std::move(file);
}

void CheckpointFile::Save(const std::function<void(BinaryWriter&)>& write_description,
                          const std::function<bool(BinaryWriter&)>& write_state) {
  if (Write(write_description, write_state, kMaxBytes)) Commit();
}

bool CheckpointFile::Write(const std::function<void(BinaryWriter&)>& write_description,
                           const std::function<bool(BinaryWriter&)>& write_state,
                           uint64_t max_new_bytes) {
  try {
    if (WriteUnsafely(write_description, write_state, max_new_bytes)) return true;
  } catch (const ObjectJournal::NoRoom&) {
    // The next call continues.
  } catch (...) {
    RemoveRemains();
    throw;
  }
  RemovePartialState();
  return false;
}

bool CheckpointFile::WriteUnsafely(const std::function<void(BinaryWriter&)>& write_description,
                                   const std::function<bool(BinaryWriter&)>& write_state,
                                   uint64_t max_new_bytes) {
  constexpr uint64_t kMinBytes = uint64_t{16} << 20;  // below, a new journal is not worth its time
  MakeFolder(folder_);
  if (!journal_file_ ||
      (journal_->is_written() && journal_->size() > kMinBytes + 2 * journal_->num_kept_bytes())) {
    BeginJournal();
  }
  journal_->SetRoom(max_new_bytes);
  Header header;
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.format = kFormat;
  header.state_checksum = kEmptyChecksum;
  BinaryWriter state(journal_.get(), [&](std::string_view bytes) {
    if (!partial_state_) {
      partial_state_ = std::make_unique<GrowingBinary>(path() + ".partial");
      partial_state_->Resize(0);
    }
    partial_state_->Write(sizeof(header) + header.state_bytes, bytes);
    header.state_bytes += bytes.size();
    header.state_checksum = Checksum(bytes, header.state_checksum);
  });
  if (!write_state(state)) return false;
  state.Flush();
  journal_->Flush();
  journal_->Keep(state.objects());

  Contents contents;
  BinaryWriter description(journal_.get());
  write_description(description);
  contents.description = description.bytes();
  contents.journal = number_;
  contents.journal_bytes = journal_->size();
  contents.journal_checksum = journal_->checksum();
  BinaryWriter rest(journal_.get());
  rest(contents);
  header.num_bytes = rest.bytes().size();
  header.checksum = Checksum(rest.bytes());
  partial_state_->Write(sizeof(header) + header.state_bytes, rest.bytes());
  partial_state_->Write(0, {reinterpret_cast<const char*>(&header), sizeof(header)});
  return true;
}

void CheckpointFile::Commit() {
  try {
    journal_file_->Sync();
    partial_state_->Sync();
    partial_state_->Rename(path());
  } catch (...) {
    RemoveRemains();
    throw;
  }
  partial_state_.reset();
  journal_->SetWritten();
  RemoveJournals(number_);
}

void CheckpointFile::RemovePartialState() {
  if (!partial_state_) return;
  std::remove(partial_state_->path().c_str());
  partial_state_.reset();
}

void CheckpointFile::RemoveRemains() {
  RemovePartialState();
  if (!Exists(folder_)) return Remove();
  if (!journal_file_) return;
  if (!journal_->is_written()) {  // the checkpoint on the disk has another journal
    CloseJournal();
    std::remove(JournalPath(number_).c_str());
    return;
  }
  journal_->RollBack();
  try {
    journal_file_->Resize(journal_->written());
  } catch (const std::exception&) {
    // The remains only take space.
  }
}

// A file that is removed takes space until it is closed.
void CheckpointFile::CloseJournal() {
  journal_.reset();  // writes to the file, too
  journal_file_.reset();
}

void CheckpointFile::RemoveJournals(int number) const {
  if (!FolderProblem(folder_).empty()) return;
  for (const std::string& entry : ListFolder(folder_)) {
    const int other = JournalNumber(entry);
    if (other != 0 && other != number) std::remove(entry.c_str());
  }
}

void CheckpointFile::Remove() {
  CloseJournal();
  partial_state_.reset();
  number_ = 0;
  if (!IsFolder(folder_)) return;
  std::remove(path().c_str());
  std::remove((path() + ".partial").c_str());
  RemoveJournals(0);
  std::remove(folder_.c_str());  // unless something else is in it
}

}  // namespace msc_vo
