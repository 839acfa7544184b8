// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_folder.h"

#include <filesystem>

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class ImageFolderTest : public TemporaryFolder {};

TEST_F(ImageFolderTest, ListsOnlyImagesInNaturalOrder) {
  WriteColor("10.png");
  WriteColor("2.JPG");
  WriteText("notes.txt", "");
  WriteText(".hidden.png", "");
  std::filesystem::create_directories(Path("3.png"));
  EXPECT_THAT(ListImages(Folder()), testing::ElementsAre(Path("2.JPG"), Path("10.png")));
  EXPECT_TRUE(ListImages(Path("nowhere")).empty());
}

TEST_F(ImageFolderTest, LeavesOutJpegCopies) {
  for (const char* name : {"1.png", "1.jpg", "2.jpeg", "2.tiff", "3.jpg"}) WriteText(name, "");
  EXPECT_THAT(ListImages(Folder()),
              testing::ElementsAre(Path("1.png"), Path("2.tiff"), Path("3.jpg")));
}

TEST_F(ImageFolderTest, ListsAllFormatsThatCanBeRead) {
  std::vector<std::string> paths;
  int number = 0;
  for (const char* ending :
       {"bmp", "exr", "jpeg", "jpg", "pgm", "png", "pnm", "ppm", "tif", "tiff", "webp"}) {
    const std::string name = std::to_string(++number) + "." + ending;
    paths.push_back(Path(name));
    WriteText(name, "");
  }
  EXPECT_THAT(ListImages(Folder()), testing::UnorderedElementsAreArray(paths));
}

}  // namespace
}  // namespace msc_vo
