// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"

namespace msc_vo {
namespace {

enum class Color { kRed, kGreen };

struct Part {
  double value = 0.0;
  std::optional<int> count;
};

struct Everything {
  bool flag = false;
  Color color = Color::kRed;
  std::string text;
  std::vector<Part> parts;
  std::vector<bool> flags;
  std::array<uint8_t, 3> bytes{};
  std::deque<int64_t> queue;
  std::set<int> ids;
  std::map<int64_t, std::string> names;
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::VectorXd vector;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  std::shared_ptr<const Part> first, second, none;
};

Everything MakeExample() {
  Everything example;
  example.flag = true;
  example.color = Color::kGreen;
  example.text = std::string("a\0b", 3);
  example.parts = {{0.1, 3}, {-std::numeric_limits<double>::infinity(), std::nullopt}};
  example.flags = {true, false, true};
  example.bytes = {1, 2, 255};
  example.queue = {-1, 5};
  example.ids = {-3, 0, 7};
  example.names = {{2, "two"}, {3, ""}};
  example.matrix << 1.0, 2.0, 3.0, 4.0;
  example.vector = Eigen::VectorXd::LinSpaced(3, 0.0, 1.0);
  example.rotation = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  example.first = std::make_shared<Part>(Part{4.5, 6});
  example.second = example.first;
  return example;
}

TEST(BinaryArchive, RestoresEveryKindOfValue) {
  const Everything example = MakeExample();
  ObjectJournal written;
  BinaryWriter writer(&written);
  writer(example);
  ObjectJournal journal(written.pending());
  BinaryReader reader(writer.bytes(), &journal);
  Everything restored;
  reader(restored);
  reader.Finish();
  EXPECT_EQ(restored.text, example.text);
  EXPECT_EQ(restored.parts[0].count, 3);
  EXPECT_EQ(restored.parts[1].value, -std::numeric_limits<double>::infinity());
  EXPECT_FALSE(restored.parts[1].count.has_value());
  EXPECT_EQ(restored.names, example.names);
  EXPECT_EQ(restored.ids, example.ids);
  EXPECT_EQ(restored.vector, example.vector);
  EXPECT_EQ(restored.first->value, 4.5);
  EXPECT_EQ(restored.first, restored.second);  // still one object
  EXPECT_EQ(restored.none, nullptr);
  // Everything else: the same bytes again.
  journal.FinishLoading();
  BinaryWriter again(&journal);
  again(restored);
  EXPECT_EQ(again.bytes(), writer.bytes());
  EXPECT_EQ(journal.pending(), "");  // the shared object is not written a second time
}

TEST(BinaryArchive, WritesSharedObjectsOnceAndForgetsThoseThatAreNotNeeded) {
  Everything example = MakeExample();
  ObjectJournal journal;
  BinaryWriter first(&journal);
  first(example);
  journal.Keep(first.objects());
  const uint64_t size = journal.size();
  EXPECT_EQ(journal.num_kept_bytes(), size);
  EXPECT_EQ(example.first.use_count(), 2);  // both pointers, not the journal
  BinaryWriter second(&journal);
  second(example);
  EXPECT_EQ(journal.size(), size);
  EXPECT_EQ(second.bytes(), first.bytes());
  journal.Keep({});
  EXPECT_EQ(journal.num_kept_bytes(), 0u);
  BinaryWriter third(&journal);
  third(example);
  EXPECT_EQ(journal.size(), 2 * size);
}

TEST(BinaryArchive, KnowsAnotherObjectAtTheSameAddress) {
  Part storage{1.0, 1};
  const auto no_deleter = [](const Part*) {};
  ObjectJournal journal;
  std::shared_ptr<const Part> part(&storage, no_deleter);
  BinaryWriter first(&journal);
  first(part);
  part.reset();
  storage.value = 2.0;
  part.reset(&storage, no_deleter);
  BinaryWriter second(&journal);
  second(part);
  EXPECT_NE(second.objects(), first.objects());
  journal.Keep(second.objects());
  BinaryWriter third(&journal);
  third(part);
  EXPECT_EQ(third.objects(), second.objects());
}

TEST(BinaryArchive, WritesOnlyBlocksThatHaveChanged) {
  constexpr size_t kSize = 2 * BinaryWriter::kBlockSize + 10;
  std::vector<Part> parts;
  for (size_t i = 0; i < kSize; ++i) parts.push_back({static_cast<double>(i), std::nullopt});
  ObjectJournal journal;
  BinaryWriter first(&journal);
  first.Blocks(parts);
  const uint64_t size = journal.size();
  parts[BinaryWriter::kBlockSize].count = 5;
  parts.push_back({-1.0, 7});
  BinaryWriter second(&journal);
  second.Blocks(parts);
  EXPECT_EQ(second.objects().front(), first.objects().front());
  EXPECT_NE(second.objects()[1], first.objects()[1]);
  EXPECT_LT(journal.size(), 2 * size);

  ObjectJournal loaded(journal.pending());
  BinaryReader reader(second.bytes(), &loaded);
  std::vector<Part> restored;
  reader.Blocks(restored);
  reader.Finish();
  ASSERT_EQ(restored.size(), parts.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(restored[i].value, parts[i].value);
    EXPECT_EQ(restored[i].count, parts[i].count);
  }
  loaded.FinishLoading();
  loaded.Keep(reader.objects());
  BinaryWriter again(&loaded);
  again.Blocks(restored);
  EXPECT_EQ(again.objects(), second.objects());
  EXPECT_EQ(loaded.pending(), "");
}

TEST(BinaryArchive, ContinuesWhereTheJournalHadNoRoom) {
  using Node = std::vector<std::shared_ptr<const std::string>>;
  auto node = std::make_shared<Node>();
  for (int i = 0; i < 4; ++i) node->push_back(std::make_shared<std::string>(100, 'x'));
  const std::shared_ptr<const Node> root = node;
  ObjectJournal journal;
  int num_parts = 0;
  for (bool is_whole = false; !is_whole; ++num_parts) {
    journal.SetRoom(150);  // two strings at a time
    BinaryWriter writer(&journal);
    ASSERT_LT(num_parts, 5);
    try {
      writer(root);
      is_whole = true;
    } catch (const ObjectJournal::NoRoom&) {
    }
  }
  EXPECT_EQ(num_parts, 3);
  BinaryWriter writer(&journal);
  writer(root);
  ObjectJournal loaded(journal.pending());
  BinaryReader reader(writer.bytes(), &loaded);
  std::shared_ptr<const Node> restored;
  reader(restored);
  reader.Finish();
  ASSERT_EQ(restored->size(), 4u);
  for (const auto& text : *restored) EXPECT_EQ(*text, std::string(100, 'x'));
}

TEST(BinaryArchive, GivesItsBytesToASink) {
  const std::vector<double> numbers(1'000'000, 0.5);
  const std::string text(300'003, 'y');
  ObjectJournal journal;
  BinaryWriter whole(&journal);
  whole(true, numbers, text, numbers, 3);
  std::string collected;
  int num_parts = 0;
  BinaryWriter writer(&journal, [&](std::string_view bytes) {
    EXPECT_EQ(collected.size() % 8, 0u);
    collected += bytes;
    ++num_parts;
  });
  writer(true, numbers, text, numbers, 3);
  writer.Flush();
  EXPECT_EQ(collected, whole.bytes());
  EXPECT_GT(num_parts, 2);
}

// No prefix and no changed byte leads to anything but the values or an error.
TEST(BinaryArchive, RefusesOtherBytes) {
  ObjectJournal written;
  BinaryWriter writer(&written);
  writer(MakeExample());
  const std::string bytes = writer.bytes();
  const auto read = [&](const std::string& changed, const std::string& objects) {
    ObjectJournal journal(objects);
    BinaryReader reader(changed, &journal);
    Everything restored;
    reader(restored);
    reader.Finish();
  };
  read(bytes, written.pending());
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(read(bytes.substr(0, size), written.pending()), std::runtime_error) << size;
  }
  EXPECT_THROW(read(bytes + "x", written.pending()), std::runtime_error);
  for (size_t size = 0; size < written.pending().size(); size += 8) {
    EXPECT_THROW(read(bytes, written.pending().substr(0, size)), std::runtime_error) << size;
  }
  for (size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(0xff);
    try {
      read(changed, written.pending());
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace msc_vo
