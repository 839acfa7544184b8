// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/results/benchmark.h"

namespace msc_vo {

/// A system with published errors.
struct PublishedSystem {
  std::string name;
  std::string source;  ///< paper and table
};

/// A sequence of a table of the literature.
struct PublishedSequence {
  std::string name;
  std::string dataset;
  std::string url;                   ///< page of the dataset
  std::vector<std::string> folders;  ///< names that the sequence has on disk, relative
  std::string format = "auto";       ///< layout, as of --format
  std::string camera;                ///< preset; empty: that of the sequence
  /// APE RMSE in metres by the name of the system; nullopt: the system failed. Systems without a
  /// published error are missing.
  std::map<std::string, std::optional<double>> errors;
};

/// Published errors of several systems on several sequences.
struct PublishedTable {
  std::string title;
  std::vector<PublishedSystem> systems;
  std::vector<PublishedSequence> sequences;
};

/// Reads a table in YAML (docs/usage.md). Throws std::runtime_error naming file, line and the valid
/// keys or values.
PublishedTable ReadPublishedTable(const std::string& path);

/// The table with the errors of `benchmark`, whose modes become its first columns, as Markdown and
/// HTML in millimetres, and as JSON in metres. Sequences without a run are marked and listed with
/// the pages of their datasets. `root`: where they were searched for.
std::string FormatPublishedMarkdown(const PublishedTable& table, const Benchmark& benchmark,
                                    const std::string& root);
std::string FormatPublishedHtml(const PublishedTable& table, const Benchmark& benchmark,
                                const std::string& root);
std::string FormatPublishedJson(const PublishedTable& table, const Benchmark& benchmark,
                                const std::string& root);

}  // namespace msc_vo
