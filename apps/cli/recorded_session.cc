// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/recorded_session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/cli/posed_images.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/image_files/jpeg_image.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/map_file/map_images.h"

namespace msc_vo {

namespace {

// A session that may have recorded the images of the sequence.
struct Candidate {
  std::string name;
  KeyframeRange range;
  std::vector<const Keyframe*> keyframes;
};

// How well the time stamps of the keyframes agree with those of the images.
enum class StampAgreement { kNone, kSome, kAllNearly, kAll };

enum class ImageAgreement { kDifferent, kUnknown, kSame };

std::string NamesOf(const std::vector<Candidate>& candidates) {
  std::string names;
  for (const Candidate& candidate : candidates) {
    names += (names.empty() ? "'" : ", '") + candidate.name + "'";
  }
  return names;
}

// The sessions that have keyframes, oldest first.
std::vector<Candidate> AllSessions(const MapContents& contents) {
  std::vector<Candidate> candidates;
  for (size_t i = 0; i < contents.sessions.size(); ++i) {
    const KeyframeId end = i + 1 < contents.sessions.size()
                               ? contents.sessions[i + 1].first_keyframe
                               : std::numeric_limits<KeyframeId>::max();
    Candidate candidate{contents.sessions[i].name, {contents.sessions[i].first_keyframe, end}, {}};
    for (const SavedSubMap& submap : contents.submaps) {
      for (const auto& [id, keyframe] : submap.map.keyframes()) {
        if (candidate.range.Contains(id)) candidate.keyframes.push_back(&keyframe);
      }
    }
    if (!candidate.keyframes.empty()) candidates.push_back(std::move(candidate));
  }
  return candidates;
}

bool HasName(const Candidate& candidate, const SessionQuery& query) {
  if (!query.session.empty()) return candidate.name == query.session;
  return candidate.name.substr(0, candidate.name.rfind(", ")) == SequenceName(query.sequence);
}

double DelayOf(const Keyframe& keyframe, const std::vector<SequenceEntry>& entries) {
  const int nearest = NearestEntry(keyframe, entries);
  return std::abs(entries[static_cast<size_t>(nearest)].timestamp - keyframe.frame->timestamp);
}

StampAgreement CompareStamps(const Candidate& candidate,
                             const std::vector<SequenceEntry>& entries) {
  constexpr double kSameStamp = 1e-6;  // lists of images have microseconds
  if (entries.empty()) return StampAgreement::kNone;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const Keyframe* keyframe : candidate.keyframes) {
    const double delay = DelayOf(*keyframe, entries);
    smallest = std::min(smallest, delay);
    largest = std::max(largest, delay);
  }
  if (smallest > kMaxPoseDelay) return StampAgreement::kNone;
  if (largest > kMaxPoseDelay) return StampAgreement::kSome;
  return largest > kSameStamp ? StampAgreement::kAllNearly : StampAgreement::kAll;
}

// Correlation of the image of a keyframe in the map with the image of the sequence. Leaves out what
// a mask has made black. nullopt: one of them cannot be compared.
std::optional<double> Correlation(const std::string& jpeg, const RgbdDecoder& images, int index) {
  constexpr int kBlack = 12;  // grey levels; JPEG does not keep 0 beside other pixels
  const cv::Mat known = DecodeJpeg(jpeg, JpegChannels::kGray);
  if (known.empty()) return std::nullopt;
  cv::Mat image;
  try {
    cv::resize(images.Decode(index).gray, image, known.size(), 0.0, 0.0, cv::INTER_AREA);
  } catch (const UnreadableImage&) {
    return std::nullopt;
  }
  const cv::Mat is_seen = known > kBlack;
  cv::Scalar mean[2], deviation[2];
  cv::meanStdDev(known, mean[0], deviation[0], is_seen);
  cv::meanStdDev(image, mean[1], deviation[1], is_seen);
  const double scale = deviation[0][0] * deviation[1][0];
  if (!(scale > 0.0)) return std::nullopt;
  cv::Mat product;
  cv::multiply(known, image, product, 1.0, CV_32F);
  return (cv::mean(product, is_seen)[0] - mean[0][0] * mean[1][0]) / scale;
}

// Compares some of the keyframes that have an image in the map.
ImageAgreement CompareImages(const MapImages& known, const Candidate& candidate,
                             const RgbdDecoder& images) {
  constexpr size_t kNumCompared = 9;  // bounds the time; a few that another object hides do no harm
  constexpr double kMinCorrelation = 0.9;  // the same images: 0.97 and more; other ones: up to 0.3
  std::vector<double> correlations;
  const size_t step = (candidate.keyframes.size() + kNumCompared - 1) / kNumCompared;
  for (size_t i = 0; i < candidate.keyframes.size(); i += step) {
    const Keyframe& keyframe = *candidate.keyframes[i];
    const std::string jpeg = known.Read(keyframe.id);
    if (jpeg.empty() || DelayOf(keyframe, images.index().entries) > kMaxPoseDelay) continue;
    const auto correlation =
        Correlation(jpeg, images, NearestEntry(keyframe, images.index().entries));
    if (correlation) correlations.push_back(*correlation);
  }
  if (correlations.empty()) return ImageAgreement::kUnknown;
  const double median = UpperMedian(std::move(correlations));
  Log().debug("session '{}': images correlate by {:.3f} with those of {}", candidate.name, median,
              images.index().directory);
  return median < kMinCorrelation ? ImageAgreement::kDifferent : ImageAgreement::kSame;
}

// Leaves the candidates that agree best, if they agree at all. Returns how they agree.
template <typename Agreement, typename Compare>
Agreement KeepBest(const Compare& compare, std::vector<Candidate>* candidates) {
  Agreement best{};
  std::vector<Candidate> kept;
  for (Candidate& candidate : *candidates) {
    const Agreement agreement = compare(candidate);
    if (agreement == Agreement{} || agreement < best) continue;
    if (agreement > best) kept.clear();
    best = agreement;
    kept.push_back(std::move(candidate));
  }
  *candidates = std::move(kept);
  return best;
}

}  // namespace

int NearestEntry(const Keyframe& keyframe, const std::vector<SequenceEntry>& entries) {
  const double stamp = keyframe.frame->timestamp;
  const auto after = std::lower_bound(
      entries.begin(), entries.end(), stamp,
      [](const SequenceEntry& entry, double time) { return entry.timestamp < time; });
  const auto index = after - entries.begin();
  if (after == entries.begin()) return 0;
  const bool is_before =
      after == entries.end() || stamp - (after - 1)->timestamp < after->timestamp - stamp;
  return static_cast<int>(is_before ? index - 1 : index);
}

KeyframeRange FindSession(const SessionQuery& query, const MapContents& contents,
                          const RgbdDecoder& images) {
  const std::vector<Candidate> all = AllSessions(contents);
  const std::string wanted =
      query.session.empty() ? query.sequence : "session '" + query.session + "'";
  const auto fail = [&](const std::string& problem) {
    throw std::runtime_error(query.map_file + ": " + problem + "; " + query.fix);
  };
  std::vector<Candidate> named;
  for (const Candidate& candidate : all) {
    const bool is_only_one = !query.requires_name && query.session.empty() && all.size() == 1;
    if (is_only_one || HasName(candidate, query)) named.push_back(candidate);
  }
  if (named.empty()) fail("has no keyframe of " + wanted + ", but of " + NamesOf(all));
  if (!query.session.empty() && named.size() == 1) return named.front().range;

  std::vector<Candidate> found = named;
  KeepBest<StampAgreement>(
      [&](const Candidate& one) { return CompareStamps(one, images.index().entries); }, &found);
  if (found.empty()) {
    fail("has no keyframe of " + wanted + ": the time stamps of " + NamesOf(named) +
         " are not those of " + images.index().directory);
  }
  const MapImages known(query.map_file);
  const ImageAgreement agreement = KeepBest<ImageAgreement>(
      [&](const Candidate& one) { return CompareImages(known, one, images); }, &found);
  if (found.empty()) {
    fail("has no keyframe of " + wanted + ": the images of " + NamesOf(named) +
         " are not those of " + images.index().directory);
  }
  if (found.size() > 1 && agreement == ImageAgreement::kUnknown) {
    fail(
        "has several sessions with these time stamps, and no images to distinguish them; none is "
        "certain to be " +
        wanted + ": " + NamesOf(found));
  }
  return found.back().range;
}

}  // namespace msc_vo
