// A board on which nothing happens by itself. It records what the machine asks of it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "machine/ports.h"

struct BoardAtRest : machine::Wire, machine::Drives, machine::Aux, machine::Clock {
  int16_t read() override {
    if (input.empty()) return -1;
    const char first = input.front();
    input.erase(0, 1);
    return uint8_t(first);
  }
  void write(char character) override { said += character; }
  uint8_t lost() override { return 0; }
  void drive(machine::Axis axis, int16_t asked) override { put(axis, asked, false); }
  void release(machine::Axis axis) override { put(axis, 0, false); }
  void brake(machine::Axis axis) override { put(axis, 0, true); }
  uint16_t count(machine::Axis axis) override { return counted[axis]; }
  uint16_t illegalSteps(machine::Axis) override { return 0; }
  void arrange(bool over_top, uint8_t pwm_choice) override {
    arranged = {float(over_top), float(pwm_choice)};
  }
  void set(machine::Output output, bool high) override {
    switched.insert(switched.end(), {float(output), float(high)});
  }
  void pulse(machine::Output output, uint8_t) override { switched.push_back(2 + float(output)); }
  void turnServo(uint8_t degrees) override { servo.push_back(degrees); }
  bool probeTouches() override { return touches; }
  uint32_t milliseconds() override { return now_ms; }
  void idle() override { ++now_ms; }
  void holdTicks() override {}
  void releaseTicks() override {}

  std::string input;                  ///< unread characters from the computer
  std::string said;                   ///< all that was written to the wire
  std::array<int16_t, 3> duty{};      ///< of each motor
  std::array<bool, 3> shorted{};      ///< whether a motor's winding is
  std::array<uint16_t, 3> counted{};  ///< count of each encoder
  std::vector<float> arranged;        ///< arguments of the last arrange()
  std::vector<float> switched;        ///< outputs, in the order asked for
  std::vector<uint8_t> servo;         ///< angles [degrees]
  bool touches = false;
  uint32_t now_ms = 0;

 private:
  void put(machine::Axis axis, int16_t asked, bool is_shorted) {
    duty[axis] = asked;
    shorted[axis] = is_shorted;
  }
};
