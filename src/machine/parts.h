// The parts that act, wired.
#pragma once

#include "axis_tests.h"
#include "drilling.h"
#include "overrides.h"
#include "settings_lines.h"
#include "single_axis.h"
#include "telemetry.h"

namespace machine {

/// The basis and the parts that act on it. Each knows the parts above it, never the parts below.
/// What takes a line or ends one stands on all of them.
struct Parts : Basis {
  Parts(const Ports& ports, const BoardName& board, Waiting& whoever_waits, Dispatch& dispatch)
      : Basis(ports, whoever_waits),
        overrides(*this),
        greeting(board, out),
        place(*this),
        reports(*this),
        telemetry(*this, place, board.start),
        motors(*this, place),
        spindle(*this),
        z(*this, place),
        door(*this, place),
        new_values(*this, place),
        coordinates(*this, place),
        settings_lines(*this, greeting, place, spindle, new_values, coordinates),
        operator_lines(*this, motors, z, door, coordinates, dispatch),
        pauses(*this, operator_lines, spindle, place),
        moves(*this, motors, coordinates, z, door, pauses),
        drilling(*this, coordinates, z, moves),
        single_axis(*this, reports, motors, place, z, door),
        axis_tests(*this, motors, place) {}

  LiveOverrides overrides;
  Greeting greeting;
  SledPlace place;
  Reports reports;
  Telemetry telemetry;
  MotorPower motors;
  Spindle spindle;
  ZAxis z;
  MotionDoor door;
  NewValues new_values;
  Coordinates coordinates;
  SettingsLines settings_lines;
  OperatorLines operator_lines;
  Pauses pauses;
  Moves moves;
  Drilling drilling;
  SingleAxis single_axis;
  AxisTests axis_tests;
};

}  // namespace machine
