// Turns places on the sheet into chain lengths and back, by the kinematics that the settings name.
#pragma once

#include <Kinematics.h>
#include <Motion.h>
#include <Settings.h>
#include <quadrilateral.h>

#include "area.h"

namespace machine {

/// Answer of forward().
struct FoundPlace {
  motion::Point<float> at;  ///< [mm] use it only if `found`
  bool found;
};

/// The machine's shape, worked out from the settings.
class Geometry {
 public:
  /// Works everything out from the settings; about 3 ms on the board.
  void prepare(const settings::Values& values);

  /// Chain lengths for a place, on the sheet or off.
  motion::Lengths<float> inverse(motion::Point<float> place) const;

  /// Where the sled hangs on chains of these lengths [mm], on the sheet or off. The search starts
  /// at `guess` [mm].
  FoundPlace forward(float left, float right, motion::Point<float> guess) const;

  /// The work area.
  Area sheet() const { return {{-half_width_, -half_height_}, {half_width_, half_height_}}; }

  /// Whether a sled can hang at a place.
  bool isReachable(motion::Point<float> place) const {
    return (is_sheet_reachable_ && sheet().holds(place)) || inverse(place).reachable;
  }

  /// Whether the whole path is on the sheet, and a sled can hang at its end.
  bool holds(const motion::Path<float>& path) const {
    return sheet().holds(path) && (is_sheet_reachable_ || inverse(path.to).reachable);
  }

  /// Where a path runs, for lib/Motion.
  motion::Space spaceOf(const motion::Path<float>& path) const {
    return sheet().holds(path) ? motion::Space::kSheet : motion::Space::kEdge;
  }

  /// [N mm] How hard the sled turns the sprocket whose chain pulls more, at a place below the
  /// motors. Its chains count as straight.
  float torqueAt(motion::Point<float> place) const;

  /// Features of the chains that lib/Motion depends on.
  const motion::Sprockets<float>& sprockets() const { return sprockets_; }

  /// The area where inverse() counts as smooth: the sheet.
  motion::SmoothArea smoothArea() const { return {half_width_, half_height_}; }

 private:
  bool isSheetReachable() const;
  /// The ring's constants, with or without what bends. Returns how large the errors are that repeat
  /// with each turn of the sprockets [mm]. Its temporaries are off the stack before the constants
  /// are used.
  __attribute__((noinline)) float shapeRing(const settings::Values& values, bool bends);
  void prepareRing(const settings::Values& values, const kinematics::Frame<float>& frame);
  void prepareBrackets(const settings::Values& values, const kinematics::Frame<float>& frame);

  /// Whether the chain is that long [mm].
  bool isChain(float length) const { return !signbit(length) && length <= chain_length_; }

  kinematics::Machine<float> ring_;
  kinematics::Quadrilateral<float> brackets_;
  motion::Sprockets<float> sprockets_;
  float half_width_, half_height_;
  float chain_length_;
  float weight_torque_;  ///< [N mm] of a sled that hangs straight below a single sprocket
  bool has_brackets_;
  bool is_sheet_reachable_;  ///< the sled can hang on the whole sheet
};

}  // namespace machine
