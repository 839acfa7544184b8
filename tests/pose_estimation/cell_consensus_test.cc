// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/cell_consensus.h"

#include <algorithm>
#include <random>

#include "tests/support/factor_checks.h"
#include <gtest/gtest.h>

#include "msc_vo/pose_estimation/image_grid.h"

namespace msc_vo {
namespace {

// A room behind a board one metre away that covers the columns from `left` to `right`. The world is
// that of the true camera; the board is where it was before it moved.
struct BoardScene {
  int num_room = 400;
  int num_board = 250;
  int num_lines = 30;  // of the room, to the right of the board
  double left = 60.0;  // pixels
  double right = 240.0;
  Eigen::Vector3d board_motion = Eigen::Vector3d(0.03, 0.0, 0.0);  // metres
  bool is_board_proven = true;
  unsigned seed = 1;
};

class BoardMaker {
 public:
  explicit BoardMaker(const BoardScene& scene) : scene_(scene), random_(scene.seed) {}

  PoseData Make() {
    PoseData data;
    data.cam_from_world = Rigid3(ExpSO3(Eigen::Vector3d(2e-3, -3e-3, 1e-3)), {4e-3, -2e-3, 3e-3});
    for (int i = 0; i < scene_.num_board; ++i) {
      const Eigen::Vector2d pixel(Uniform(scene_.left, scene_.right), Uniform(50.0, 479.0));
      AddPoint(pixel, 1.0, -scene_.board_motion, scene_.is_board_proven, &data);
    }
    while (static_cast<int>(data.points.size()) < scene_.num_board + scene_.num_room) {
      const Eigen::Vector2d pixel(Uniform(0.0, 639.0), Uniform(0.0, 479.0));
      if (IsBoard(pixel)) continue;
      AddPoint(pixel, Uniform(2.0, 5.0), Eigen::Vector3d::Zero(), true, &data);
    }
    for (int i = 0; i < scene_.num_lines; ++i) AddLine(&data);
    return data;
  }

  bool IsBoard(const Eigen::Vector2d& pixel) const {
    return pixel.x() > scene_.left && pixel.x() < scene_.right && pixel.y() > 50.0;
  }

 private:
  double Uniform(double low, double high) {
    return low + (high - low) * (random_() / 4294967296.0);
  }

  void AddPoint(const Eigen::Vector2d& pixel, double z, const Eigen::Vector3d& offset,
                bool confirmed, PoseData* data) {
    PoseData::Point point;
    point.position = data->camera.BackProject(pixel, z) + offset;
    point.pixel = pixel + 0.7 * Eigen::Vector2d(normal_(random_), normal_(random_));
    point.inverse_depth_sigma = 2e-3;
    point.inverse_depth = 1.0 / z + point.inverse_depth_sigma * normal_(random_);
    point.confirmed = proven;
    data->points.push_back(point);
  }

  void AddLine(PoseData* data) {
    const double y = Uniform(20.0, 460.0);
    const double z = Uniform(2.0, 5.0);
    PoseData::Line line;
    line.segment.start = {scene_.right + 20.0, y};
    line.segment.end = {630.0, Uniform(20.0, 460.0)};
    line.map_segment.start = data->camera.BackProject(line.segment.start, z);
    line.map_segment.end = data->camera.BackProject(line.segment.end, z + 0.5);
    line.sigma = 0.15;  // as learnt from rendered rooms
    line.segment.start.y() += line.sigma * normal_(random_);
    line.segment.end.y() += line.sigma * normal_(random_);
    data->lines.push_back(line);
  }

  BoardScene scene_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

double ErrorOf(const BoardScene& scene, const PoseOptions& options) {
  PoseData data = BoardMaker(scene).Make();
  EXPECT_TRUE(OptimizePose(options, &data).usable);
  return data.cam_from_world.translation().norm();  // the true one is the identity
}

PoseOptions WithoutConsensus() {
  PoseOptions options;
  options.consensus.enabled = false;
  return options;
}

// Turning and moving along, a camera explains the board and nearly explains the room.
TEST(CellConsensusTest, ABoardThatMovesDoesNotMoveTheCamera) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    BoardScene scene;
    scene.seed = seed;
    // Measured over these: 0.3 to 1.4 mm, and 38 to 39 mm without.
    EXPECT_LT(ErrorOf(scene, PoseOptions()), 0.004) << seed;
    EXPECT_GT(ErrorOf(scene, WithoutConsensus()), 0.03) << seed;
  }
}

TEST(CellConsensusTest, WhatMovesIsSaidAndIsNeitherInlierNorFailure) {
  const BoardScene scene;
  const BoardMaker maker(scene);
  PoseData data = BoardMaker(scene).Make();
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  int board_moves = 0, room_moves = 0;
  for (const PoseData::Point& point : data.points) {
    EXPECT_FALSE(point.dynamic && point.inlier);
    (maker.IsBoard(point.pixel) ? board_moves : room_moves) += point.dynamic;
  }
  EXPECT_GT(board_moves, 0.9 * scene.num_board);
  EXPECT_LT(room_moves, 0.2 * scene.num_room);  // parts at the edges hold both
  EXPECT_EQ(summary.num_dynamic,
            board_moves + room_moves +
                std::count_if(data.lines.begin(), data.lines.end(),
                              [](const PoseData::Line& l) { return l.dynamic; }));
  // Matches move with their part (a line: of its middle), and parts without a match rest.
  const CellConsensusOptions options;
  const ImageGrid parts(options.columns, options.rows, data.camera);
  ASSERT_EQ(summary.dynamic_cells.size(), static_cast<size_t>(parts.size()));
  std::vector<bool> with_matches(parts.size());
  for (const PoseData::Point& point : data.points) {
    EXPECT_EQ(point.dynamic, summary.dynamic_cells[parts.CellOf(point.pixel)]);
    with_matches[parts.CellOf(point.pixel)] = true;
  }
  for (const PoseData::Line& line : data.lines) {
    EXPECT_EQ(line.dynamic, summary.dynamic_cells[parts.CellOf(line.segment)]);
    for (const int part : parts.CellsOf(line.segment)) with_matches[part] = true;
  }
  for (int part = 0; part < parts.size(); ++part) {
    EXPECT_TRUE(with_matches[part] || !summary.dynamic_cells[part]) << part;
  }
}

TEST(CellConsensusTest, ItDoesNotMatterWhereTheBoardIs) {
  for (const double left : {0.0, 120.0, 230.0, 340.0}) {
    BoardScene scene;
    scene.left = left;
    scene.right = left + 180.0;
    EXPECT_LT(ErrorOf(scene, PoseOptions()), 0.005) << left;
  }
}

TEST(CellConsensusTest, ARoomThatStandsStillIsLeftAlone) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    BoardScene scene;
    scene.board_motion = Eigen::Vector3d::Zero();
    scene.seed = seed;
    PoseData with = BoardMaker(scene).Make();
    PoseData without = with;
    const PoseSummary summary = OptimizePose(PoseOptions(), &with);
    EXPECT_EQ(summary.num_dynamic, 0) << seed;
    EXPECT_TRUE(summary.dynamic_cells.empty()) << seed;
    OptimizePose(WithoutConsensus(), &without);
    EXPECT_EQ(with.cam_from_world.params, without.cam_from_world.params) << seed;
  }
}

// The room has a tenth of the points, in as many parts as the board. Its lines run through more.
TEST(CellConsensusTest, LinesVoteWhereverTheyRun) {
  int num_captured = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    BoardScene scene;
    scene.seed = seed;
    scene.num_room = 25;
    scene.right = 180.0;
    scene.board_motion = {0.08, 0.0, 0.0};
    EXPECT_LT(ErrorOf(scene, PoseOptions()), 0.01) << seed;  // measured: 0.6 to 2 mm
    scene.num_lines = 3;
    num_captured += ErrorOf(scene, PoseOptions()) > 0.02 ? 1 : 0;
  }
  EXPECT_GE(num_captured, 4);  // without them; measured: 5 of 6
}

// Half of the image each.
TEST(CellConsensusTest, WhatIsProvenHasMoreToSay) {
  BoardScene scene;
  scene.left = 0.0;
  scene.right = 340.0;
  scene.num_board = 400;
  scene.num_lines = 0;
  scene.board_motion = {0.03, 0.0, 0.0};
  scene.is_board_proven = false;
  EXPECT_LT(ErrorOf(scene, PoseOptions()), 0.01);
  scene.is_board_proven = true;
  EXPECT_GT(ErrorOf(scene, PoseOptions()), 0.02);
}

TEST(CellConsensusTest, RejectsOptionsThatMeanNothing) {
  const auto is_valid = [](void (*spoil)(CellConsensusOptions*)) {
    CellConsensusOptions options;
    spoil(&options);
    std::string error;
    return options.IsValid(&error) || error.find("consensus: ") != 0;
  };
  EXPECT_FALSE(is_valid([](CellConsensusOptions* o) { o->columns = 0; }));
  EXPECT_FALSE(is_valid([](CellConsensusOptions* o) { o->rows = 0; }));
  EXPECT_FALSE(is_valid([](CellConsensusOptions* o) { o->reject_chi2_6 = 0.0; }));
  EXPECT_FALSE(is_valid([](CellConsensusOptions* o) { o->min_cells = -1.0; }));
  EXPECT_FALSE(is_valid([](CellConsensusOptions* o) { o->unconfirmed_weight = 0.0; }));
  EXPECT_FALSE(is_valid([](CellConsensusOptions* o) { o->unconfirmed_weight = 1.5; }));
}

}  // namespace
}  // namespace msc_vo
