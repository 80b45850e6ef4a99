// The lives of the machine between power cuts, in order.
#include "life.h"

#include "settings_flash.h"

namespace {

/// From power-on to power cut or the dialogue's end.
void liveOnce(Stage& stage, const machine::BoardName& board) {
  const FlashTable table;
  machine::Machine machine({stage, stage, stage, stage, stage.eeprom, table}, board);
  stage.tick = [&] { machine.tick(); };
  machine.begin();
  for (;;) machine.loop();
}

}  // namespace

void live(Stage& stage, const machine::BoardName& board) {
  for (;;) {
    try {
      liveOnce(stage, board);
    } catch (const PowerGone&) {
      stage.tick = [] {};
      stage.restart();
    } catch (const TheEnd&) {
      return;
    }
  }
}
