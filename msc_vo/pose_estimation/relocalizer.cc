// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/relocalizer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/line_alignment.h"
#include "msc_vo/geometry/rigid_alignment.h"

namespace msc_vo {

namespace {

// Errors of angles and distances between measured lines: three sigmas of a direction with
// a standard deviation of two degrees, and of a depth of 3 metres by structured light.
const AlignmentTolerance kTolerance{DegreesToRadians(6.0), 0.04};
constexpr double kToleranceDepth = 3.0;  // metres
// Largest relative difference between the inverse depth of a supporting line and its measurement.
constexpr double kMaxDepthError = 0.1;
// Hypotheses from pairs of lines, those that look most alike.
constexpr size_t kMaxLinePairs = 150;
// Triples of points, and half as many of a line and a point: with 30 % inliers, 200 triples contain
// a clean one with 99.6 % probability.
constexpr int kMaxIterations = 200;
// Reprojection error of an inlier, radians: the error of a rotation from two lines or three points,
// whose depths are noisy. 9 pixels at a focal length of 525.
constexpr double kMaxAngle = DegreesToRadians(1.0);

constexpr int kNoBits = 257;  // more than the 256 bits of a descriptor
// Bits between descriptors; stricter than for matching by projection, where the predicted position
// excludes most wrong candidates.
constexpr int kMaxBits = 64;
constexpr double kMaxRatio = 0.8;  // best over second best descriptor distance, of points

// Lines with a less certain direction do not determine a rotation.
constexpr double kMaxDirectionSigma = DegreesToRadians(5.0);
// Bounds of the search, which is quadratic in their product. Forty lines cover a view.
constexpr size_t kMaxLines = 40;
constexpr size_t kMaxPairsPerLine = 3;

// Score of the second best pose, relative to the best, above which neither is believed.
constexpr double kMaxRival = 0.8;

// A line of a frame that may be a line of the map, both measured in 3-D.
struct LinePair {
  int feature = 0;
  int candidate = 0;    // index in LocalMap::lines
  LineSegment3 in_cam;  // metres, camera
  LineSegment3 in_world;
  int distance = 0;  // bits, between the descriptors
};

// The longest lines of the frame whose direction is known in 3-D, longest first.
std::vector<int> LongestLines(const Frame& frame) {
  std::vector<int> longest;
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    const LineFeature& line = frame.lines[i];
    if (line.dynamic || !line.depth) continue;
    if (DirectionSigma(frame.camera, line.segment, *line.depth) > kMaxDirectionSigma) continue;
    longest.push_back(static_cast<int>(i));
  }
  std::stable_sort(longest.begin(), longest.end(), [&frame](int a, int b) {
    return frame.lines[a].segment.Length() > frame.lines[b].segment.Length();
  });
  if (longest.size() > kMaxLines) longest.resize(kMaxLines);
  return longest;
}

// Matches every point of `frame` that has a depth with the candidate nearest by descriptor,
// unless the second nearest is about as near.
std::vector<PointMatch> MatchPointDescriptors(const Frame& frame,
                                              const std::vector<PointCandidate>& candidates) {
  std::vector<PointMatch> matches;
  for (size_t feature = 0; feature < frame.points.size(); ++feature) {
    if (frame.points[feature].dynamic || !frame.points[feature].HasDepth()) continue;
    const PointCandidate* best = nullptr;
    int best_distance = kNoBits;
    int second_distance = kNoBits;
    for (const PointCandidate& candidate : candidates) {
      const int distance = HammingDistance(candidate.descriptor, frame.points[feature].descriptor);
      if (distance < best_distance) {
        second_distance = best_distance;
        best_distance = distance;
        best = &candidate;
      } else if (distance < second_distance) {
        second_distance = distance;
      }
    }
    if (best == nullptr || best_distance > kMaxBits) continue;
    if (best_distance > kMaxRatio * second_distance) continue;
    matches.push_back({static_cast<int>(feature), best->id, best->position, true});
  }
  return matches;
}

// Pairs the longest lines of `frame` whose direction is known in 3-D with the few candidates that
// are nearest by descriptor: along one edge of a box, several lines look alike.
std::vector<LinePair> MatchLineDescriptors(const Frame& frame,
                                           const std::vector<LineCandidate>& candidates) {
  std::vector<LinePair> pairs;
  for (const int feature : LongestLines(frame)) {
    std::vector<LinePair> nearest;
    for (size_t i = 0; i < candidates.size(); ++i) {
      const int distance =
          HammingDistance(candidates[i].descriptor, frame.lines[feature].descriptor);
      if (distance > kMaxBits) continue;
      nearest.push_back({feature, static_cast<int>(i), frame.LineInCamera(feature),
                         candidates[i].segment, distance});
    }
    std::stable_sort(nearest.begin(), nearest.end(),
                     [](const LinePair& a, const LinePair& b) { return a.distance < b.distance; });
    if (nearest.size() > kMaxPairsPerLine) nearest.resize(kMaxPairsPerLine);
    pairs.insert(pairs.end(), nearest.begin(), nearest.end());
  }
  return pairs;
}

// Draws `count` distinct indices below `size` >= count.
std::vector<int> Draw(int count, int size, std::mt19937* random) {
  std::vector<int> drawn;
  while (static_cast<int>(drawn.size()) < count) {
    const int i = static_cast<int>((*random)() % static_cast<unsigned>(size));
    if (std::find(drawn.begin(), drawn.end(), i) == drawn.end()) drawn.push_back(i);
  }
  return drawn;
}

// Whether the line of the map has the measured depth at the middle of the feature.
bool HasMeasuredDepth(const Frame& frame, const LineMatch& match, const Rigid3& cam_from_world) {
  const LineFeature& feature = frame.lines[match.feature];
  if (!feature.depth) return true;
  const std::optional<double> inverse_depth =
      InverseDepthAt(frame.camera, feature.segment, cam_from_world * match.segment, 0.5);
  const double measured = feature.depth->At(0.5);
  return inverse_depth && std::abs(*inverse_depth - measured) <= kMaxDepthError * measured;
}

// Whether two triangles have the same sides, within the error of depths, which grows with the
// square of the depth.
bool AreOneTriangle(const std::vector<Eigen::Vector3d>& in_world,
                    const std::vector<Eigen::Vector3d>& in_cam) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double depth =
        std::max({kToleranceDepth, in_cam[i].z(), in_cam[j].z()}) / kToleranceDepth;
    const double difference = (in_world[i] - in_world[j]).norm() - (in_cam[i] - in_cam[j]).norm();
    if (!(std::abs(difference) <= kTolerance.distance * depth * depth)) return false;
  }
  return true;
}

// The search for one frame.
class PoseSearch {
 public:
  PoseSearch(const RelocalizerOptions& options, const LineMatcherOptions& line_matcher,
             const Frame& frame, const LocalMap& candidates)
      : options_(options),
        line_matcher_(line_matcher),
        frame_(frame),
        candidates_(candidates),
        points_(MatchPointDescriptors(frame, candidates.points)),
        lines_(MatchLineDescriptors(frame, candidates.lines)),
        random_(static_cast<uint32_t>(frame.id)) {}

  // All hypotheses with enough support, the best supported first.
  std::vector<Relocalization> Hypotheses() {
    AddLinePairs();
    AddLinesWithPoints();
    AddPointTriples();
    std::stable_sort(
        hypotheses_.begin(), hypotheses_.end(),
        [](const Relocalization& a, const Relocalization& b) { return a.score > b.score; });
    return std::move(hypotheses_);
  }

 private:
  void AddLinePairs() {
    struct Pair {
      size_t a, b;
      int distance;
    };
    std::vector<Pair> pairs;
    for (size_t a = 0; a < lines_.size(); ++a) {
      for (size_t b = a + 1; b < lines_.size(); ++b) {
        pairs.push_back({a, b, lines_[a].distance + lines_[b].distance});
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& p, const Pair& q) { return p.distance < q.distance; });
    size_t num_aligned = 0;
    for (const Pair& pair : pairs) {
      const LinePair &a = lines_[pair.a], &b = lines_[pair.b];
      if (a.feature == b.feature || a.candidate == b.candidate) continue;
      const std::optional<Rigid3> pose =
          AlignLines({a.in_world, b.in_world}, {a.in_cam, b.in_cam}, kTolerance);
      if (!pose) continue;
      Add(*pose);
      if (++num_aligned == kMaxLinePairs) return;
    }
  }

  void AddLinesWithPoints() {
    if (lines_.empty() || points_.empty()) return;
    for (int i = 0; i < kMaxIterations / 2; ++i) {
      const LinePair& line = lines_[random_() % lines_.size()];
      const PointMatch& point = points_[random_() % points_.size()];
      const std::optional<Rigid3> pose =
          AlignLineAndPoint(line.in_world, point.position, line.in_cam,
                            frame_.PointInCamera(point.feature), kTolerance);
      if (pose) Add(*pose);
    }
  }

  void AddPointTriples() {
    if (points_.size() < 3) return;
    for (int i = 0; i < kMaxIterations; ++i) {
      std::vector<Eigen::Vector3d> in_world;
      std::vector<Eigen::Vector3d> in_cam;
      for (const int k : Draw(3, static_cast<int>(points_.size()), &random_)) {
        in_world.push_back(points_[k].position);
        in_cam.push_back(frame_.PointInCamera(points_[k].feature));
      }
      if (AreOneTriangle(in_world, in_cam)) Add(AlignRigid(in_world, in_cam));
    }
  }

  // Scores a pose and keeps it if its support suffices.
  void Add(const Rigid3& cam_from_world) {
    Relocalization hypothesis;
    hypothesis.cam_from_world = cam_from_world;
    FrameMatches& matches = hypothesis.matches;
    const double radius = frame_.camera.fx * std::tan(kMaxAngle);
    double score = 0.0;
    for (const PointMatch& match : points_) {
      const Eigen::Vector3d in_cam = cam_from_world * match.position;
      const Eigen::Vector2d& pixel = frame_.points[match.feature].pixel;
      if (!(in_cam.z() > 0.0)) continue;
      const double error = (frame_.camera.Project(in_cam) - pixel).norm() / radius;
      if (!(error < 1.0)) continue;
      matches.points.push_back(match);
      score += 1.0 - error * error;
    }
    visible_lines_.clear();
    for (const LineCandidate& line : candidates_.lines) {
      visible_lines_.push_back(line);
      if (!ProjectCandidate(frame_.camera, cam_from_world, &visible_lines_.back())) {
        visible_lines_.pop_back();
      }
    }
    for (const LineMatch& match : MatchLines(line_matcher_, frame_, visible_lines_, radius, {})) {
      if (HasMeasuredDepth(frame_, match, cam_from_world)) matches.lines.push_back(match);
    }
    const size_t lines = LineLandmark::kSupport * matches.lines.size();
    if (matches.points.size() + lines < static_cast<size_t>(options_.min_inliers)) return;
    hypothesis.score = score + static_cast<double>(lines);
    hypotheses_.push_back(std::move(hypothesis));
  }

  const RelocalizerOptions& options_;
  const LineMatcherOptions& line_matcher_;
  const Frame& frame_;
  const LocalMap& candidates_;
  std::vector<PointMatch> points_;  // by descriptor
  std::vector<LinePair> lines_;
  std::mt19937 random_;
  std::vector<LineCandidate> visible_lines_;  // from the pose that is being scored
  std::vector<Relocalization> hypotheses_;
};

bool IsSameLandmark(const PointMatch& a, const PointMatch& b) { return a.position == b.position; }
bool IsSameLandmark(const LineMatch& a, const LineMatch& b) {
  return a.segment.start == b.segment.start && a.segment.end == b.segment.end;
}

// Number of matches in both; each in the order of the features.
template <typename M>
size_t NumShared(const std::vector<M>& a, const std::vector<M>& b) {
  size_t num_shared = 0;
  auto other = b.begin();
  for (const M& match : a) {
    while (other != b.end() && other->feature < match.feature) ++other;
    if (other == b.end()) break;
    if (other->feature == match.feature && IsSameLandmark(match, *other)) ++num_shared;
  }
  return num_shared;
}

// Whether two hypotheses are estimates of one pose: they explain most features by the same
// landmarks. Their poses may differ, as those from short or distant lines do.
bool AreOnePose(const FrameMatches& a, const FrameMatches& b) {
  const size_t num_shared = NumShared(a.points, b.points) + NumShared(a.lines, b.lines);
  return 2 * num_shared >=
         std::min(a.points.size() + a.lines.size(), b.points.size() + b.lines.size());
}

}  // namespace

std::vector<Relocalization> FindPoses(const RelocalizerOptions& options,
                                      const LineMatcherOptions& line_matcher, const Frame& frame,
                                      const LocalMap& candidates, int max_poses) {
  std::vector<Relocalization> poses;
  for (Relocalization& hypothesis :
       PoseSearch(options, line_matcher, frame, candidates).Hypotheses()) {
    if (static_cast<int>(poses.size()) >= max_poses) break;
    const bool is_new =
        std::none_of(poses.begin(), poses.end(), [&hypothesis](const Relocalization& pose) {
          return AreOnePose(pose.matches, hypothesis.matches);
        });
    if (is_new) poses.push_back(std::move(hypothesis));
  }
  return poses;
}

std::optional<Relocalization> Relocalize(const RelocalizerOptions& options,
                                         const LineMatcherOptions& line_matcher, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe) {
  const std::vector<Relocalization> poses =
      FindPoses(options, line_matcher, frame, LandmarksOf(map, keyframe), 2);
  if (poses.empty()) return std::nullopt;
  if (poses.size() > 1 && poses[1].score > kMaxRival * poses[0].score) return std::nullopt;
  return poses.front();
}

}  // namespace msc_vo
