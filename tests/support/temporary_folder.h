// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace msc_vo {

// A folder of its own for each test, deleted when the test ends.
class TemporaryFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::path(testing::TempDir()) / "msc_vo_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  // The folder has this path instead.
  void SetUpAt(const std::string& path) {
    std::filesystem::create_directories(path);
    folder_ = path;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string Path(const std::string& name) const {
    // Tests that run at the same time would share the working directory.
    if (folder_.empty()) throw std::logic_error("TemporaryFolder::SetUp() was not called");
    return (folder_ / name).string();
  }
  std::string Folder() const { return folder_.string(); }

  void WriteText(const std::string& name, const std::string& text) const {
    Make(name);
    std::ofstream(Path(name), std::ios::binary) << text;
  }
  // A grey level or a raw depth everywhere.
  void WriteImage(const std::string& name, int type, double value, int width = 8,
                  int height = 6) const {
    Make(name);
    ASSERT_TRUE(cv::imwrite(Path(name), cv::Mat(height, width, type, cv::Scalar::all(value))));
  }
  void WriteColor(const std::string& name, int width = 8, int height = 6) const {
    WriteImage(name, CV_8UC3, 100, width, height);
  }
  void WriteDepth(const std::string& name, double raw = 5000, int width = 8, int height = 6) const {
    WriteImage(name, CV_16UC1, raw, width, height);
  }

 private:
  void Make(const std::string& name) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
  }

  std::filesystem::path folder_;
};

// A folder that has the same files at the begin of each test of a suite. The first test makes them;
// the others get a copy at the same path, which the files may contain.
class PreparedFolder : public TemporaryFolder {
 protected:
  static void TearDownTestSuite() {
    if (!prepared_.empty()) std::filesystem::remove_all(prepared_);
    path_.clear();
    prepared_.clear();
  }
  void SetUp() override {
    namespace fs = std::filesystem;
    if (!path_.empty()) {
      SetUpAt(path_);
      fs::copy(prepared_, path_, fs::copy_options::recursive);
      return;
    }
    TemporaryFolder::SetUp();
    Prepare();
    path_ = Folder();
    prepared_ = path_ + "_prepared";
    fs::copy(path_, prepared_, fs::copy_options::recursive);
  }

  // Makes the files.
  virtual void Prepare() = 0;

 private:
  static inline std::string path_;
  static inline std::string prepared_;
};

// The message of the exception that `action` throws; empty if it throws none.
inline std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace msc_vo
