// A chain that climbs over a tooth of its sprocket and so slips by a link.
#pragma once

#include <algorithm>
#include <cmath>

namespace world {

/// The way of a chain over a tooth.
///
/// A #25 chain on the Maslow's ten teeth. While the sprocket turns by half a link, the roller rises
/// from its seat to the tip: the chain pays out half a link, and pulls on a longer arm. Past the
/// tip the chain pulls nothing, and the sled falls by the other half. Then the chain catches it,
/// and the catch gives back the push that was missing.
class Climb {
 public:
  /// `turned` [mm]: where the sprocket is.
  void begin(double turned) { *this = Climb(), stage_ = kRises, turned_ = turned; }
  bool isOn() const { return stage_ != kSeated; }
  /// The chain's torque at the sprocket, times that of a seated chain.
  double share() const {
    if (stage_ == kRises) return 1 + (kTipArm - 1) * paid_ / kHalf;
    return stage_ == kFalls ? 0 : stage_ == kCatches ? 1 + fell_for_ / kCatchLasts : 1;
  }

  /// [mm] What the chain pays out on top of the sprocket's turns in some seconds, until the
  /// sprocket is at `turned` [mm]; `tension` [N] of the seated chain.
  double advance(double seconds, double turned, double tension) {
    const double before = paid_;
    since_ += seconds;
    if (stage_ == kRises) {
      paid_ = std::min(paid_ + std::fabs(turned - turned_), kHalf);
      if (paid_ == kHalf) enter(kFalls);
    } else if (stage_ == kFalls) {
      const double metres = 0.5 * tension / kSledMass * since_ * since_;
      paid_ = std::min(kHalf + 1000 * metres, 2 * kHalf);
      fell_for_ = since_;
      if (paid_ == 2 * kHalf) enter(kCatches);
    } else if (since_ >= kCatchLasts) {
      enter(kSeated);
    }
    turned_ = turned;
    return paid_ - before;
  }

 private:
  enum Stage { kSeated, kRises, kFalls, kCatches };
  static constexpr double kHalf = 3.175;  // [mm] half a link
  // Of a roller's centre, 13.33 mm over the tip and 10.27 mm in its seat: pitch 6.35 mm, roller
  // 3.30 mm, outside diameter 6.35 mm (0.6 + cot 18 degrees).
  static constexpr double kTipArm = 1.297;
  static constexpr double kSledMass = 10;      // [kg]
  static constexpr double kCatchLasts = 0.02;  // [s] a quarter swing of the sled on a chain's give

  void enter(Stage stage) { stage_ = stage, since_ = 0; }

  Stage stage_ = kSeated;
  double turned_ = 0, paid_ = 0;     // [mm]
  double since_ = 0, fell_for_ = 0;  // [s]
};

}  // namespace world
