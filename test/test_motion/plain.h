// A mover on a machine whose chain lengths are x and y, so that set-points show where the sled is.
#pragma once

#include <Motion.h>

#include <cmath>
#include <functional>
#include <vector>

const double kTick = 0.01;  // [s]

/// The firmware's defaults: 100 mm/s^2, 10 for z, chains 20 mm/s, z 0.66, corners within 0.05.
const motion::Limits kGentle = {100, 10, 20, 0.66f, 0.05f};

/// Set-points of the axes at a tick [mm].
struct Asked {
  double x, y, z;
};

inline double distance(const Asked& a, const Asked& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                   (a.z - b.z) * (a.z - b.z));
}

/// The left chain is x, the right chain y.
inline motion::Lengths<float> plainInverse(motion::Point<float> place) {
  return {place.x, place.y, std::fabs(place.x) < 3000};
}

/// A mover, its set-points, and a tick that takes one of them.
class Plain {
 public:
  explicit Plain(const motion::Limits& limits = kGentle, double seconds = kTick)
      : seconds(seconds) {
    mover.prepare(limits, float(seconds));
    // Sprockets so far away that only the path's curvature counts.
    mover.setSprockets({{-1e6f, 1e6f}, {1e6f, 1e6f}, {0, 0, 0}});
    mover.standAt({0, 0, 0});
  }

  void lineTo(float x, float y, float z = 0, float feed = 15) {
    const motion::Point<float> to = {x, y};
    add(motion::line(at, to), z, feed);
    at = to;
  }

  void arcTo(float x, float y, motion::Point<float> centre, float feed = 15, float z = 0) {
    const motion::Point<float> to = {x, y};
    add(motion::arc(at, to, centre, motion::Turn::kCounterclockwise), z, feed);
    at = to;
  }

  /// Ticks until there is room, then queues.
  void add(const motion::Path<float>& path, float z, float feed) {
    while (!mover.hasRoom()) tick();
    added = mover.add(path, z, feed);
  }

  /// A control tick after the main program has filled the ring. False if the ring was empty.
  bool tick() {
    filled = mover.fill(set_points, inverse);
    return tickAlone();
  }

  /// A control tick while the main program is busy with something else.
  bool tickAlone() {
    const bool took = playback.next(set_points, now);
    asked.push_back({motion::toMm<double>(now.left), motion::toMm<double>(now.right),
                     motion::toMm<double>(now.z)});
    return took;
  }

  void run() {
    while (tick()) {
    }
  }

  /// Speeds from tick to tick [mm/s].
  std::vector<double> speeds() const {
    std::vector<double> speeds;
    Asked before = {0, 0, 0};
    for (const Asked& each : asked) {
      speeds.push_back(distance(each, before) / seconds);
      before = each;
    }
    return speeds;
  }

  double seconds;
  motion::Mover mover;
  motion::SetPoints set_points;
  motion::Playback playback;
  std::function<motion::Lengths<float>(motion::Point<float>)> inverse = plainInverse;
  motion::Point<float> at = {0, 0};
  motion::SetPoint now = {0, 0, 0};
  motion::Added added = motion::Added::kNothing;
  motion::Filled filled = motion::Filled::kYes;
  std::vector<Asked> asked;
};
