// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/run_identity.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "apps/cli/commands.h"
#include "msc_vo/checkpoint/checksum.h"
#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/datasets/image_masks.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// Two builds of the same version may round differently. Where the file of the program cannot be
// found, the version must do.
std::string DescribeProgram() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  const std::string version = std::string("msc_vo ") + kVersion;
  return file ? version + ", checksum " + ChecksumText(bytes.str()) : version;
}

void AddImages(const SequenceIndex& index, std::map<std::string, std::string>* facts) {
  const SequenceIdentity sequence = IdentifySequence(index);
  (*facts)["sequence: format"] = index.format;
  (*facts)["sequence: number of images"] = std::to_string(index.entries.size());
  (*facts)["sequence: checksum of the time stamps"] = sequence.stamps;
  (*facts)["sequence: checksum of names and sizes of the images"] = sequence.images;
  (*facts)["sequence: raw depth without a measurement"] = std::to_string(index.invalid_depth);
  (*facts)["sequence: settings"] = index.container ? index.container->Settings() : "";
  (*facts)["option camera.float_depth_scale"] = FormatNumber(index.float_depth_scale);
  (*facts)["--mask"] = index.masks ? index.masks->description() : "off";
  const DepthLimits& limits = index.clipped_depth.limits;
  (*facts)["sequence: raw depths at which it is clipped"] =
      FormatNumber(limits.nearest) + " " + FormatNumber(limits.farthest);
  (*facts)["sequence: colour is scaled to depth"] = index.scale_color ? "true" : "false";
}

}  // namespace

RunIdentity IdentifyRun(const RgbdDecoder& decoder, const Configuration& configuration,
                        const GravityArguments& gravity, const MapArguments& map) {
  RunIdentity identity;
  identity.arguments = CommandArguments();
  identity.command_line = CommandLine();
  std::error_code error;
  identity.folder = fs::current_path(error).string();
  identity.program = DescribeProgram();
  Configuration copy = configuration;
  for (const Option& option : ListOptions(&copy)) {
    if (option.AffectsResults()) identity.facts["option " + option.path] = FormatOption(option);
  }
  AddImages(decoder.index(), &identity.facts);
  identity.facts["camera"] = FormatCameraFile(decoder.calibration(), "camera");
  identity.facts["--gravity"] =
      gravity.enabled ? gravity.axes + " " + FormatNumber(gravity.sigma) : "off";
  identity.facts["--map"] = map.map;
  identity.facts["--localize"] = map.localize;
  return identity;
}

std::string DescribeDifference(const RunIdentity& saved, const RunIdentity& present) {
  const auto difference = [](const std::string& name, const std::string& then,
                             const std::string& now) {
    return "is of another run: " + name + " was '" + Trimmed(then) + "' and is '" + Trimmed(now) +
           "' now";
  };
  if (saved.program != present.program) {
    return "is of another build of the program (" + saved.program + "; this is " + present.program +
           "), which may not give the same results; resume with that program, or start the run "
           "again without --resume";
  }
  constexpr char kFix[] =
      "; give the sequence and the options of the run, or none of them, or start a new run without "
      "--resume";
  for (const auto& [name, now] : present.facts) {
    const auto then = saved.facts.find(name);
    const std::string value = then == saved.facts.end() ? "" : then->second;
    if (value != now) return difference(name, value, now) + kFix;
  }
  if (saved.facts.size() != present.facts.size()) return std::string("is of another run") + kFix;
  return "";
}

}  // namespace msc_vo
