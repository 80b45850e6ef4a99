// Moves of a single axis by its length: calibration, chains by hand, the probe.
#pragma once

#include "answers.h"
#include "motion_door.h"
#include "motor_power.h"
#include "sled_place.h"
#include "waiting.h"
#include "z_axis.h"

namespace machine {

/// B02, B06, B08 to B10, B15 and G38.2.
class SingleAxis {
 public:
  SingleAxis(const settings::Values& values, const Geometry& geometry, Axes& axes, Planner& mover,
             MotorPower& motors, SledPlace& place, ZAxis& z, MotionDoor& door, Aux& aux,
             const gcode::Modal& modal, Printer& out, Answers& answers, Waiting& waiting)
      : values_(values),
        geometry_(geometry),
        axes_(axes),
        planner_(mover),
        motors_(motors),
        place_(place),
        z_(z),
        door_(door),
        aux_(aux),
        modal_(modal),
        out_(out),
        answers_(answers),
        waiting_(waiting) {}

  /// [mm] Whether a chain or z can be that long.
  static bool isLength(float value) { return float(fabs(value)) <= kMostTravel; }

  /// B02: pays out a chain to the length for hooking the sled on.
  bool measureOut(Axis axis);
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
  /// G38.2: z goes down until the probe touches; there z becomes zero.
  bool probe(float target);

 private:
  bool move(Axis axis, float goal, float feed, bool until_probe = false);
  void sayProbing(float target, float feed);

  const settings::Values& values_;
  const Geometry& geometry_;
  Axes& axes_;
  Planner& planner_;
  MotorPower& motors_;
  SledPlace& place_;
  ZAxis& z_;
  MotionDoor& door_;
  Aux& aux_;
  const gcode::Modal& modal_;
  Printer& out_;
  Answers& answers_;
  Waiting& waiting_;
};

}  // namespace machine
