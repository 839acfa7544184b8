// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "msc_vo/datasets/rgbd_camera.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

/// Takes images from a live camera on a thread of its own. If the reader is late, images wait in a
/// queue; the oldest ones are dropped when the queue gets too long, so that memory stays bounded.
class CameraSource {
 public:
  /// An image is dropped when another one arrives whose stamp is `max_waiting` seconds later. The
  /// camera must outlive the source.
  CameraSource(RgbdCamera* camera, double max_waiting);
  ~CameraSource();  ///< waits for the image that is being taken
  CameraSource(const CameraSource&) = delete;
  CameraSource& operator=(const CameraSource&) = delete;

  /// Returns the oldest waiting image, or waits for the next one. Adds the number of images dropped
  /// since the last call to `num_dropped`. Returns false at the end. Rethrows the
  /// exception of the camera after the images before it.
  bool Next(CameraImage* image, int* num_dropped);

  /// Milliseconds since the image that Next() returned last arrived.
  double AgeMilliseconds() const { return age_.Milliseconds() + waited_; }

 private:
  struct Waiting {
    CameraImage image;
    Stopwatch since_arrival;
  };
  void TakeImages();
  // Drops the images that are too old when one with the stamp `newest` arrives.
  void MakeRoom(double newest);

  RgbdCamera* camera_;
  double max_waiting_;  // seconds
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;  // guarded by mutex_, as all below up to thread_
  int num_dropped_ = 0;
  bool ended_ = false;
  bool stopping_ = false;
  std::exception_ptr error_;
  Stopwatch age_;        // since Next() returned; used by the reader only
  double waited_ = 0.0;  // milliseconds that its image had waited
  std::thread thread_;
};

}  // namespace msc_vo
