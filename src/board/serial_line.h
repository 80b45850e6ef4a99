// The serial line to the computer: 57600 baud as the Mega's USB chip makes it, buffered both ways.
#pragma once

#include "machine/ports.h"

namespace board {

/// UART 0. There is only one; its buffers belong to the interrupts.
class SerialLine : public machine::Wire {
 public:
  void begin();
  int16_t read() override;
  void write(char character) override;
  uint8_t lost() override;
};

}  // namespace board
