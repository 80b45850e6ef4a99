// What every part of the machine stands on.
#pragma once

#include <GCode.h>

#include "answers.h"
#include "cutter.h"
#include "planner.h"
#include "position_keeper.h"
#include "program_place.h"
#include "waiting.h"

namespace machine {

/// What the machine needs of a board.
struct Ports {
  Wire& wire;
  Drives& drives;
  Aux& aux;
  Clock& clock;
  settings::Bytes& bytes;
  const settings::Table& table;
};

/// The board, the numbers, the axes and the words to the computer. Parts that act stand on it; each
/// gets it, and the parts that it knows, in its constructor.
struct Basis {
  Basis(const Ports& ports, Waiting& whoever_waits)
      : wire(ports.wire),
        drives(ports.drives),
        aux(ports.aux),
        clock(ports.clock),
        waiting(whoever_waits),
        out(ports.wire),
        values(ports.table, room),
        memory(ports.bytes, values),
        axes(ports.drives, ports.clock),
        course(axes),
        keeper(memory, axes),
        cutter(ports.aux, values),
        answers(out, values) {}

  Wire& wire;
  Drives& drives;
  Aux& aux;
  Clock& clock;
  Waiting& waiting;
  Printer out;
  float room[kSettingCount];
  settings::Values values;
  settings::Memory memory;
  Geometry geometry;
  gcode::Input input;
  gcode::Modal modal;
  Axes axes;
  Course course;
  Planner planner;
  PositionKeeper keeper;
  Cutter cutter;
  Answers answers;
  ProgramPlace program;
};

}  // namespace machine
