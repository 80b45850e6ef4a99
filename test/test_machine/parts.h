// The parts of a machine around a board at rest, so that each can be tested alone.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/parts.h"
#include "settings_flash.h"

/// A main program whose rounds take a millisecond each; motors are simulated by B99.
struct Rounds : machine::Waiting {
  Rounds(BoardAtRest& board, machine::Parts& parts)
      : Waiting(board, parts.axes, parts.planner, parts.course),
        course(parts.course),
        board_(board),
        parts_(parts) {}

  void service() override {
    ++rounds;
    in_each_round();
    parts_.planner.fill(axes_, parts_.geometry);
    parts_.memory.step();
    if (++board_.now_ms % 10 == 0) axes_.tick();
  }
  bool runQuestion(const char*) override { return true; }
  void answer(bool) override {}
  void stop() { course.take(machine::Event::kStop); }

  machine::Course& course;
  int rounds = 0;
  std::function<void()> in_each_round = [] {};

 private:
  BoardAtRest& board_;
  machine::Parts& parts_;
};

/// What a machine needs of a board.
struct BoardOfParts {
  BoardAtRest board;
  settings_host::Eeprom eeprom;
  FlashTable table;
};

/// A machine with a ring whose sled hangs in the middle of the sheet.
struct PartsAtRest : testing::Test, BoardOfParts, machine::Parts {
  PartsAtRest()
      : Parts({board, board, board, board, eeprom, BoardOfParts::table},
              {2, "", machine::Start::kUsual}, waiting),
        waiting(board, *this) {
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

  void hangAt(float x, float y) {
    const motion::Lengths<float> lengths = geometry.inverse({x, y});
    axes.declare(machine::kLeftAxis, lengths.left);
    axes.declare(machine::kRightAxis, lengths.right);
    keeper.declareChains();
    place.search(machine::Search::kHalted);
  }

  /// The words of a line's first code.
  static gcode::Words words(const char* text) {
    gcode::Piece piece;
    gcode::Pieces(text).next(piece);
    return piece.words;
  }

  void expectSaid(const std::string& text) {
    EXPECT_NE(std::string::npos, board.said.find(text)) << "said: " << board.said;
  }
  Rounds waiting;
};
