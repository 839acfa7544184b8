// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/depth_folder.h"

#include <filesystem>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {
namespace {

using testing::Contains;
using testing::IsEmpty;

class DepthFolderTest : public TemporaryFolder {};

TEST_F(DepthFolderTest, PrefersDepthThatIsRegisteredToColour) {
  for (const std::string name :
       {"aligned_depth", "depth_aligned", "aligned_depth_to_color", "depth_registered"}) {
    WriteDepth("depth/0.png");
    WriteDepth(name + "/0.png");
    std::vector<std::string> warnings;
    EXPECT_EQ(FindDepth(Folder(), "", &warnings), Path(name));
    EXPECT_THAT(warnings, Contains(Names(name, "depth", "registered")));
    std::filesystem::remove_all(Path("depth"));
    warnings.clear();
    EXPECT_EQ(FindDepth(Folder(), "", &warnings), Path(name));
    EXPECT_THAT(warnings, IsEmpty());
    std::filesystem::remove_all(Path(name));
  }
  EXPECT_EQ(FindDepth(Folder(), ""), "");
}

TEST_F(DepthFolderTest, NamesMayBeInCapitals) {
  for (const auto& [color, depth] : {std::pair("RGB", "Depth"), std::pair("Images", "depths")}) {
    WriteColor(std::string(color) + "/1.png");
    WriteDepth(std::string(depth) + "/1.png");
    EXPECT_EQ(OpenSequence(Folder()).entries.size(), 1u);
    std::filesystem::remove_all(Path(color));
    std::filesystem::remove_all(Path(depth));
  }
  WriteText("RGB.txt", "time path\n1.5 \"a b.png\"\n");
  WriteText("Depth.TXT", "1.5 d.png\n");
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 1u);
  EXPECT_EQ(index.entries[0].color_path, Path("a b.png"));
}

TEST_F(DepthFolderTest, IgnoresOtherNamesAndFoldersWithoutImages) {
  WriteDepth("depth/0.png");
  WriteDepth("depth_unaligned/0.png");
  WriteText("aligned_depth/readme.txt", "");
  WriteColor("aligned/0.png");
  WriteDepth("depth_aligned_preview/0.png");
  EXPECT_EQ(FindDepth(Folder(), ""), Path("depth"));
}

TEST_F(DepthFolderTest, FilesBesideImagesAreNoLists) {
  WriteColor("rgb/0.png");
  WriteDepth("depth/0.png");
  WriteText("aligned_depth_camera_info.txt", "525 525 319.5 239.5\n");
  WriteText("aligned_depth.txt", "of the driver\n");
  EXPECT_EQ(OpenSequence(Folder()).format, "rgb-depth");
}

TEST_F(DepthFolderTest, ReadsListsOfRegisteredDepth) {
  WriteText("color.txt", "1.0 color/a.png\n1.1 color/b.png\n");
  WriteText("depth.txt", "1.0 depth/a.png\n1.1 depth/b.png\n");
  WriteText("aligned_depth.txt", "1.0 aligned_depth/a.png\n1.1 aligned_depth/b.png\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "tum");
  ASSERT_EQ(index.entries.size(), 2u);
  EXPECT_EQ(index.entries[1].depth_path, Path("aligned_depth/b.png"));
  EXPECT_THAT(index.warnings, Contains(Names("aligned_depth.txt", "depth.txt")));
}

TEST_F(DepthFolderTest, ListsMayQuotePathsOfAnotherSystem) {
  WriteText("rgb.txt", "1.0,\"rgb\\a.png\"\n");
  WriteText("depth.txt", "1.0,depth\\a.png\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.entries.at(0).color_path, Path("rgb/a.png"));
  EXPECT_EQ(index.entries.at(0).depth_path, Path("depth/a.png"));
}

TEST_F(DepthFolderTest, ReadsFoldersOfRegisteredDepth) {
  WriteColor("color/0.png");
  WriteDepth("depth_registered/0.png");
  WriteDepth("depth/0.png");
  EXPECT_EQ(OpenSequence(Folder()).entries.at(0).depth_path, Path("depth_registered/0.png"));
}

TEST_F(DepthFolderTest, NamesArraysThatAreNoImages) {
  WriteColor("rgb/0.png");
  WriteText("depth/0.npy", "");
  EXPECT_THAT(MessageOf([&] { OpenSequence(Folder()); }), Names("1", "0", "0.npy", "PNG"));
}

}  // namespace
}  // namespace msc_vo
