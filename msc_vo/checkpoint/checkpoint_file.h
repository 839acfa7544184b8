// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <string>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/checkpoint/growing_binary.h"
#include "msc_vo/checkpoint/object_journal.h"

namespace msc_vo {

/// The checkpoint of a run in a folder: `state.bin`, which each checkpoint replaces, and
/// `objects-<number>.bin`, the journal of immutable objects that it refers to. Both are versioned
/// and have checksums. All goes to the files as it is written, so that a checkpoint takes little
/// memory. A checkpoint is whole or absent: the old one is valid until the new one is complete on
/// the disk.
class CheckpointFile {
 public:
  /// Creates no file. Save() replaces an earlier checkpoint in the folder.
  explicit CheckpointFile(std::string folder);

  /// Opens the checkpoint in `folder`. Throws std::runtime_error that names the file and the fix if
  /// there is none, if it is damaged, or of another version of the format.
  static CheckpointFile Open(const std::string& folder);
  /// Whether the folder has a checkpoint. It may be damaged.
  static bool Exists(const std::string& folder);

  /// Calls `read` with a reader of the checkpoint, whose errors get the name of the file.
  /// `description` and `state`: what Save() wrote. Call ReadState() once, after Open().
  void ReadDescription(const std::function<void(BinaryReader&)>& read);
  void ReadState(const std::function<void(BinaryReader&)>& read);

  /// Writes a checkpoint unless `write_state` returns false. Creates the folder. The journal is
  /// begun anew when most of it is no longer needed. Throws std::runtime_error naming the file; the
  /// checkpoint before remains, and takes no more space than before.
  void Save(const std::function<void(BinaryWriter&)>& write_description,
            const std::function<bool(BinaryWriter&)>& write_state);

  /// The two parts of Save(), which throw as it does. Write() hands all bytes to the operating
  /// system, and returns false if `write_state` does, or if new objects of `max_new_bytes` have
  /// been written and there are more: call it again later, which continues with them. After true,
  /// Commit() waits for the disk and replaces the checkpoint before. It may run on another thread,
  /// and nothing else may be called until it returns.
  bool Write(const std::function<void(BinaryWriter&)>& write_description,
             const std::function<bool(BinaryWriter&)>& write_state, uint64_t max_new_bytes);
  void Commit();
  /// Removes the checkpoint and its folder.
  void Remove();

  /// Path of state.bin.
  std::string path() const;

 private:
  bool WriteUnsafely(const std::function<void(BinaryWriter&)>& write_description,
                     const std::function<bool(BinaryWriter&)>& write_state, uint64_t max_new_bytes);
  std::string JournalPath(int number) const;
  // Removes the journals but that of `number`.
  void RemoveJournals(int number) const;
  void BeginJournal();
  void CloseJournal();
  void RemovePartialState();
  // Removes what a checkpoint that could not be written has left.
  void RemoveRemains();

  std::string folder_;
  int number_ = 0;  // of the journal; 0: none
  std::unique_ptr<ObjectJournal> journal_;
  std::shared_ptr<GrowingBinary> journal_file_;
  std::unique_ptr<GrowingBinary> partial_state_;  // null: none is written
  std::string description_;
  std::string state_;
};

}  // namespace msc_vo
