// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/checkpoint_file.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using Objects = std::vector<std::shared_ptr<const std::string>>;

class CheckpointFileTest : public TemporaryFolder {
 protected:
  // Objects of a kilobyte.
  static Objects MakeObjects(int count) {
    Objects objects;
    for (int i = 0; i < count; ++i) {
      objects.push_back(std::make_shared<std::string>(1024, static_cast<char>('a' + i % 26)));
    }
    return objects;
  }
  static void Save(const std::string& description, const Objects& objects, CheckpointFile* file) {
    file->Save([&](BinaryWriter& archive) { archive(description); },
               [&](BinaryWriter& archive) {
                 archive(objects);
                 return true;
               });
  }
  std::string State() const { return Path("checkpoint/state.bin"); }
  // Reads the checkpoint; returns the objects in one text.
  std::string Read(std::string* description = nullptr) const {
    CheckpointFile file = CheckpointFile::Open(Path("checkpoint"));
    std::string unused;
    file.ReadDescription(
        [&](BinaryReader& archive) { archive(description != nullptr ? *description : unused); });
    Objects objects;
    file.ReadState([&](BinaryReader& archive) { archive(objects); });
    std::string text;
    for (const auto& object : objects) text += *object;
    return text;
  }
  static std::string TextOf(const Objects& objects) {
    std::string text;
    for (const auto& object : objects) text += *object;
    return text;
  }
  void ExpectRefused(const std::string& file, const std::string& reason) const {
    EXPECT_THAT(MessageOf([this] { Read(); }), Names(Path(file), reason, "--resume"));
  }
  void Overwrite(const std::string& name, size_t position, char value) const {
    std::string bytes = ReadFile(Path(name));
    bytes.at(position) = value;
    WriteText(name, bytes);
  }
};

TEST_F(CheckpointFileTest, ReplacesTheLastCheckpointAndAppendsNewObjects) {
  CheckpointFile file(Path("checkpoint"));
  EXPECT_FALSE(CheckpointFile::Exists(Path("checkpoint")));
  Objects objects = MakeObjects(3);
  Save("first", objects, &file);
  EXPECT_TRUE(CheckpointFile::Exists(Path("checkpoint")));
  const std::string journal = ReadFile(Path("checkpoint/objects-1.bin"));
  objects.push_back(std::make_shared<std::string>("new"));
  Save("second", objects, &file);
  const std::string longer = ReadFile(Path("checkpoint/objects-1.bin"));
  EXPECT_EQ(longer.substr(0, journal.size()), journal);
  EXPECT_LT(longer.size(), journal.size() + 100);
  std::string description;
  EXPECT_EQ(Read(&description), TextOf(objects));
  EXPECT_EQ(description, "second");
  file.Remove();
  EXPECT_FALSE(HasEntry(Path("checkpoint")));
}

TEST_F(CheckpointFileTest, ContinuesAfterOpening) {
  Objects objects = MakeObjects(3);
  {
    CheckpointFile file(Path("checkpoint"));
    Save("run", objects, &file);
  }
  // A run that was killed while it wrote the next checkpoint.
  const std::string journal = ReadFile(Path("checkpoint/objects-1.bin"));
  WriteText("checkpoint/objects-1.bin", journal + "half an object");
  CheckpointFile file = CheckpointFile::Open(Path("checkpoint"));
  file.ReadState([&](BinaryReader& archive) { archive(objects); });
  objects.push_back(std::make_shared<std::string>("new"));
  Save("run", objects, &file);
  EXPECT_LT(ReadFile(Path("checkpoint/objects-1.bin")).size(), journal.size() + 100);
  EXPECT_EQ(Read(), TextOf(objects));
}

TEST_F(CheckpointFileTest, LeavesOutObjectsThatAreNoLongerNeeded) {
  CheckpointFile file(Path("checkpoint"));
  const Objects kept = MakeObjects(1);
  for (int i = 0; i < 5; ++i) {
    Objects objects = MakeObjects(6000);  // 6 MB
    objects.push_back(kept.front());
    Save("run", objects, &file);
  }
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-1.bin")).size(), 5 * 6000 * 1040u + 1040u);
  Save("run", kept, &file);
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-2.bin")).size(), 1040u);
  EXPECT_FALSE(HasEntry(Path("checkpoint/objects-1.bin")));
  EXPECT_EQ(Read(), TextOf(kept));
}

TEST_F(CheckpointFileTest, KeepsTheOldCheckpointUntilTheNewOneIsWhole) {
  CheckpointFile old(Path("checkpoint"));
  const Objects objects = MakeObjects(2);
  Save("old", objects, &old);
  CheckpointFile next(Path("checkpoint"));
  EXPECT_THROW(next.Save([](BinaryWriter&) {},
                         [](BinaryWriter& archive) -> bool {
                           archive(1);
                           throw std::runtime_error("out of memory");
                         }),
               std::runtime_error);
  next.Save([](BinaryWriter&) {}, [](BinaryWriter&) { return false; });
  EXPECT_EQ(Read(), TextOf(objects));
  std::filesystem::create_directories(Path("checkpoint/state.bin.partial"));  // cannot be written
  EXPECT_THAT(MessageOf([&] { Save("new", MakeObjects(3), &next); }),
              Names(State() + ".partial", "opened"));
  EXPECT_EQ(Read(), TextOf(objects));
}

TEST_F(CheckpointFileTest, LeavesNothingOfACheckpointThatCannotBeWritten) {
  const auto fail = [](CheckpointFile* file) {
    EXPECT_THROW(file->Save([](BinaryWriter&) {},
                            [](BinaryWriter&) -> bool { throw std::runtime_error("full"); }),
                 std::runtime_error);
  };
  CheckpointFile file(Path("checkpoint"));
  fail(&file);
  EXPECT_FALSE(HasEntry(Path("checkpoint")));
  Objects objects = MakeObjects(3);
  Save("run", objects, &file);
  const std::string earlier = TextOf(objects);
  const std::string journal = ReadFile(Path("checkpoint/objects-1.bin"));

  objects.push_back(std::make_shared<std::string>("new"));
  WriteText("checkpoint/state.bin.partial/entry", "");  // cannot be opened
  EXPECT_THROW(Save("run", objects, &file), std::runtime_error);
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-1.bin")), journal);
  EXPECT_EQ(Read(), earlier);
  CheckpointFile other(Path("checkpoint"));  // of a run that would replace this one
  EXPECT_THROW(Save("other", objects, &other), std::runtime_error);
  EXPECT_FALSE(HasEntry(Path("checkpoint/objects-2.bin")));
  EXPECT_EQ(Read(), earlier);

  std::filesystem::remove_all(Path("checkpoint/state.bin.partial"));
  Save("run", objects, &file);
  EXPECT_EQ(Read(), TextOf(objects));
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-1.bin")).substr(0, journal.size()), journal);
}

TEST_F(CheckpointFileTest, ContinuesTheJournalAfterAFailureInTheMiddle) {
  CheckpointFile file(Path("checkpoint"));
  Objects objects = MakeObjects(3);
  Save("run", objects, &file);
  const std::string earlier = TextOf(objects);
  const std::string journal = ReadFile(Path("checkpoint/objects-1.bin"));

  const Objects more = MakeObjects(3000);  // 3 MB, which do not wait in memory
  EXPECT_THROW(file.Save([](BinaryWriter&) {},
                         [&](BinaryWriter& archive) -> bool {
                           archive(more);
                           EXPECT_GT(ReadFile(Path("checkpoint/objects-1.bin")).size(), 2'000'000u);
                           throw std::runtime_error("full");
                         }),
               std::runtime_error);
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-1.bin")), journal);
  EXPECT_EQ(Read(), earlier);

  objects.insert(objects.end(), more.begin(), more.end());
  Save("run", objects, &file);
  EXPECT_EQ(Read(), TextOf(objects));
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-1.bin")).size(), journal.size() + 3000 * 1040u);
}

TEST_F(CheckpointFileTest, IsWrittenInPartsAndValidOnceItIsCommitted) {
  CheckpointFile file(Path("checkpoint"));
  Objects objects = MakeObjects(2);
  Save("first", objects, &file);
  const std::string earlier = TextOf(objects);
  const Objects more = MakeObjects(9);
  objects.insert(objects.end(), more.begin(), more.end());
  const auto write = [&] {
    return file.Write([](BinaryWriter& archive) { archive(std::string("second")); },
                      [&](BinaryWriter& archive) {
                        archive(objects);
                        return true;
                      },
                      3000);  // three objects at a time
  };
  EXPECT_FALSE(write());
  EXPECT_FALSE(HasEntry(State() + ".partial"));
  objects.erase(objects.begin() + 3);  // one that is written already
  EXPECT_FALSE(write());
  EXPECT_TRUE(write());
  EXPECT_TRUE(HasEntry(State() + ".partial"));
  std::filesystem::copy(Path("checkpoint"), Path("killed"));
  file.Commit();
  EXPECT_FALSE(HasEntry(State() + ".partial"));
  EXPECT_EQ(Read(), TextOf(objects));
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-1.bin")).size(), 11 * 1040u);

  std::filesystem::remove_all(Path("checkpoint"));
  std::filesystem::rename(Path("killed"), Path("checkpoint"));
  EXPECT_EQ(Read(), earlier);
}

TEST_F(CheckpointFileTest, BeginsAJournalOnceAlsoInParts) {
  CheckpointFile file(Path("checkpoint"));
  for (int i = 0; i < 2; ++i) Save("run", MakeObjects(20000), &file);  // 40 MB
  const Objects kept = MakeObjects(19);
  Save("run", kept, &file);
  const Objects next = MakeObjects(1);
  const auto write = [&] {
    return file.Write([](BinaryWriter&) {},
                      [&](BinaryWriter& archive) {
                        archive(kept, next);
                        return true;
                      },
                      10 * 1024);
  };
  EXPECT_FALSE(write());
  EXPECT_TRUE(write());
  file.Commit();
  EXPECT_EQ(ReadFile(Path("checkpoint/objects-2.bin")).size(), 20 * 1040u);
  EXPECT_FALSE(HasEntry(Path("checkpoint/objects-1.bin")));
  EXPECT_FALSE(HasEntry(Path("checkpoint/objects-3.bin")));
}

TEST_F(CheckpointFileTest, RefusesDamagedAndForeignFiles) {
  ExpectRefused("checkpoint/state.bin", "does not exist");
  CheckpointFile file(Path("checkpoint"));
  Save("run", MakeObjects(2), &file);
  const std::string state = ReadFile(State());
  for (const size_t size : {size_t{0}, size_t{47}, size_t{48}, state.size() - 1}) {
    WriteText("checkpoint/state.bin", state.substr(0, size));
    ExpectRefused("checkpoint/state.bin", "is truncated");
  }
  for (size_t i = 16; i < state.size(); i += 7) {
    WriteText("checkpoint/state.bin", state);
    Overwrite("checkpoint/state.bin", i, static_cast<char>(state[i] + 1));
    const bool is_size = i < 24 || (i >= 32 && i < 40);  // the file may then be too short
    ExpectRefused("checkpoint/state.bin", is_size ? "" : "is damaged");
  }
  WriteText("checkpoint/state.bin", state);
  Overwrite("checkpoint/state.bin", 8, 99);
  ExpectRefused("checkpoint/state.bin", "format 99");
  WriteText("checkpoint/state.bin", std::string(100, 'x'));
  ExpectRefused("checkpoint/state.bin", "not a checkpoint");
  WriteText("checkpoint/state.bin", state);

  const std::string journal = ReadFile(Path("checkpoint/objects-1.bin"));
  Overwrite("checkpoint/objects-1.bin", 1000, '!');
  ExpectRefused("checkpoint/objects-1.bin", "is damaged");
  WriteText("checkpoint/objects-1.bin", journal.substr(0, journal.size() - 1));
  ExpectRefused("checkpoint/objects-1.bin", "is truncated");
  std::filesystem::remove(Path("checkpoint/objects-1.bin"));
  ExpectRefused("checkpoint/objects-1.bin", "does not exist");
}

}  // namespace
}  // namespace msc_vo
