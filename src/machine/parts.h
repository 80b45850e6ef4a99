// The parts of the machine, wired.
#pragma once

#include "answers.h"
#include "axis_tests.h"
#include "cutter.h"
#include "drilling.h"
#include "greeting.h"
#include "overrides.h"
#include "position_keeper.h"
#include "settings_lines.h"
#include "single_axis.h"
#include "telemetry.h"

namespace machine {

/// The board, the settings, the axes, the printer, and the parts that act. Those that act get all
/// of it, and use what is above them, never what is below.
struct Parts : Ports {
  Parts(const Ports& ports, const BoardName& board, Waiting& whoever_waits)
      : Ports(ports), waiting(whoever_waits), greeting(board, out), telemetry(*this, board.start) {}

  Waiting& waiting;
  Printer out{wire};
  float room[kSettingCount];
  settings::Values values{table, room};
  settings::Memory memory{bytes, values};
  Geometry geometry;
  gcode::Input input;
  gcode::Modal modal;
  Axes axes{drives, clock};
  Course course{axes};
  Planner planner;
  PositionKeeper keeper{memory, axes};
  Cutter cutter{aux, values};
  Answers answers{out, values};
  ProgramPlace program;

  LiveOverrides overrides{*this};
  Greeting greeting;
  SledPlace place{*this};
  Reports reports{*this};
  Telemetry telemetry;
  MotorPower motors{*this};
  Spindle spindle{*this};
  ZAxis z{*this};
  NewValues new_values{*this};
  Coordinates coordinates{*this};
  SettingsLines settings_lines{*this};
  OperatorLines operator_lines{*this};
  Moves moves{*this};
  Drilling drilling{*this};
  SingleAxis single_axis{*this};
  AxisTests axis_tests{*this};
};

}  // namespace machine
