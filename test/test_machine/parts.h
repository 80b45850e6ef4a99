// The parts of a machine around a board at rest, so that each can be tested alone.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/axis_tests.h"
#include "machine/drilling.h"
#include "machine/new_values.h"
#include "machine/operator_lines.h"
#include "machine/single_axis.h"
#include "settings_flash.h"

/// A main program whose rounds take a millisecond each; motors are simulated by B99.
struct Rounds : machine::Waiting {
  Rounds(BoardAtRest& board, machine::Axes& axes, machine::Planner& planner,
         machine::Geometry& geometry, settings::Memory& memory)
      : Waiting(board, axes, planner, course),
        board_(board),
        planner_(planner),
        geometry_(geometry),
        memory_(memory) {}

  void service() override {
    ++rounds;
    in_each_round();
    planner_.fill(axes_, geometry_);
    memory_.step();
    if (++board_.now_ms % 10 == 0) axes_.tick();
  }
  void stop() { course.take(machine::Event::kStop); }

  machine::Course course{axes_};
  int rounds = 0;
  std::function<void()> in_each_round = [] {};

 private:
  BoardAtRest& board_;
  machine::Planner& planner_;
  machine::Geometry& geometry_;
  settings::Memory& memory_;
};

/// A machine with a ring whose sled hangs in the middle of the sheet.
struct Parts : testing::Test, machine::Dispatch {
  Parts()
      : values(table, room),
        memory(eeprom, values),
        out(board),
        axes(board, board),
        keeper(memory, axes),
        waiting(board, axes, planner, geometry, memory),
        cutter(board, values),
        answers(out, values),
        place(out, axes, geometry, planner, keeper, memory, modal, program),
        motors(axes, keeper, values, place, geometry, out, waiting),
        spindle(cutter, board, out, waiting),
        z(memory, values, axes, place, modal, out, answers),
        door(values, axes, place, answers),
        new_values(values, geometry, axes, planner, board, cutter, place, board, out),
        coordinates(memory, values, modal, place, program, out, answers),
        operator_lines(waiting.course, input, modal, axes, motors, z, door, coordinates, board, out,
                       answers, *this),
        pauses(operator_lines, input, modal, spindle, place, out, waiting),
        moves(values, geometry, planner, motors, coordinates, program, z, door, cutter, pauses,
              modal, out, answers, waiting),
        drilling(modal, coordinates, program, z, moves, answers, waiting),
        single_axis(values, geometry, axes, planner, motors, place, z, door, board, program, modal,
                    out, answers, waiting),
        axis_tests(axes, values, out, motors, place, waiting) {
    memory.start();
    values.setRow(kKinematics, 2);
    values.setRow(kRotationRadius, 139);
    values.setRow(kZPositionP, 1300);
    axes.simulate(true);
    new_values.takeAll();
    modal.feed = 600;
    hangAt(0, 0);
    board.said.clear();
  }

  bool runQuestion(const char* line) override {
    asked = line;
    return true;
  }
  void answer(bool done) override { answered.push_back(done); }

  void hangAt(float x, float y) {
    const motion::Lengths<float> lengths = geometry.inverse({x, y});
    axes.declare(machine::kLeftAxis, lengths.left);
    axes.declare(machine::kRightAxis, lengths.right);
    keeper.declareChains();
    place.search(machine::Search::kHalted);
  }

  /// The words of a line's first code.
  static gcode::Piece piece(const char* text) {
    gcode::Piece piece;
    gcode::Pieces(text).next(piece);
    return piece;
  }
  static gcode::Words words(const char* text) { return piece(text).words; }

  void expectSaid(const std::string& text) {
    EXPECT_NE(std::string::npos, board.said.find(text)) << "said: " << board.said;
  }
  void expectAt(float x, float y, float z_at) {
    const machine::Place at = place.now(waiting.isMoving());
    EXPECT_NEAR(x, at.x, 0.02);
    EXPECT_NEAR(y, at.y, 0.02);
    EXPECT_NEAR(z_at, at.z, 0.002);
  }

  BoardAtRest board;
  settings_host::Eeprom eeprom;
  FlashTable table;
  float room[kSettingCount];
  settings::Values values;
  settings::Memory memory;
  machine::Printer out;
  machine::Geometry geometry;
  gcode::Input input;
  gcode::Modal modal;
  machine::Axes axes;
  machine::Planner planner;
  machine::PositionKeeper keeper;
  Rounds waiting;
  machine::Cutter cutter;
  machine::Answers answers;
  machine::ProgramPlace program;
  machine::SledPlace place;
  machine::MotorPower motors;
  machine::Spindle spindle;
  machine::ZAxis z;
  machine::MotionDoor door;
  machine::NewValues new_values;
  machine::Coordinates coordinates;
  machine::OperatorLines operator_lines;
  machine::Pauses pauses;
  machine::Moves moves;
  machine::Drilling drilling;
  machine::SingleAxis single_axis;
  machine::AxisTests axis_tests;
  std::string asked;
  std::vector<bool> answered;
};
