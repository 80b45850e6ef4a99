// Drives and a clock that do nothing by themselves.
#pragma once

#include <array>

#include "machine/ports.h"

/// Motors whose encoders show the counts that a test sets, whatever their duty.
struct SetCounts : machine::Drives {
  void drive(machine::Axis, int16_t) override {}
  void release(machine::Axis) override {}
  void brake(machine::Axis) override {}
  uint16_t count(machine::Axis axis) override { return counted[axis]; }
  uint16_t illegalSteps(machine::Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}
  std::array<uint16_t, machine::kAxisCount> counted{};
};

/// A clock that stands still.
struct NoClock : machine::Clock {
  uint32_t milliseconds() override { return 0; }
  void idle() override {}
  void holdTicks() override {}
  void releaseTicks() override {}
};
