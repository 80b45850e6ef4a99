// Moves of a single axis by its length: calibration, chains by hand, the probe.
#pragma once

#include "motor_power.h"
#include "reports.h"
#include "z_axis.h"

namespace machine {

/// B02, B06, B08 to B10, B15 and G38.2 to G38.5.
class SingleAxis {
 public:
  explicit SingleAxis(Parts& parts) : parts_(parts) {}

  /// [mm] Whether a chain or z can be that long.
  static bool isLength(float value) { return float(fabs(value)) <= kMostTravel; }

  /// B02: pays out a chain to the length for hooking the sled on.
  bool measureOut(Axis axis);
  /// Refuses lengths of chains [mm] that would put the sled far off the sheet.
  bool mayHang(float left, float right);
  /// B06: declares the lengths of the chains [mm].
  bool setChains(float left, float right);
  /// B08: declares that the chains are at their marks.
  bool setChainsToMarks();
  /// B09: moves chains to lengths, or by lengths with G91.
  bool moveChains(const gcode::Words& words);
  /// B15: moves to the middle of the sheet, chain by chain.
  bool goHome();
  /// B10.
  bool measureChain(bool left);
  /// G38.2 to G38.5: z goes on until the probe touches, or, away from it, until it lets go. There z
  /// becomes zero, but keeps its height for a Grbl sender, which counts from there. False,
  /// with a refusal, also where it goes to the end though it must not.
  bool probe(float target, bool until_touch, bool must);
  /// Says where the last probe ended, for a Grbl sender.
  void sayProbed();

 private:
  /// Reasons to end a move before its goal.
  enum class Until : uint8_t { kGoal, kTouch, kLetGo };
  bool move(Axis axis, float goal, float feed, Until until = Until::kGoal);
  void sayProbing(float target, float feed);

  Parts& parts_;
  Place probed_ = {0, 0, 0};
  bool has_probed_ = false;
};

}  // namespace machine
