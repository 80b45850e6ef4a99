// Axes with gains and no power, on a board that a test chooses.
#pragma once

#include "board_at_rest.h"
#include "machine/axes.h"
#include "settings_flash.h"

/// `Board` is a BoardAtRest, or adds something to it.
template <class Board>
struct PreparedAxes {
  PreparedAxes() : values(table, room) {
    values.setRow(kZPositionP, 1300);
    axes.prepare(values);
    axes.forgetRawCounts();
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) axes.tick();
  }

  const FlashTable table;
  float room[kSettingCount];
  settings::Values values;
  Board board;
  machine::Axes axes{board, board};
};
