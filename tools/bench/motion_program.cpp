// Follows lines and arcs over the sheet on the (simulated) Mega at 900 mm/min, with the default
// machine's exact inverse; marks as in board_program.cpp.
#include <Motion.h>
#include <avr/io.h>
#include <avr/sleep.h>

#include "Kinematics.h"
#include "motion_cases.h"

using kinematics::EffectParams;
using kinematics::Feed;
using kinematics::Found;
using kinematics::Frame;
using kinematics::Machine;
using kinematics::PaidOut;
using motion::Knot;
using motion::Lengths;
using motion::Outcome;
using motion::Path;
using motion::PathFollower;
using motion::Point;

namespace {

// The compiler must not move work across a mark.
#define BARRIER() __asm__ __volatile__("" ::: "memory")

const float kHalfWidth = 1219.2f, kHalfHeight = 609.6f;         // [mm]
const float kHalfGap = 1489.2f, kMotorHeight = 609.6f + 463;    // [mm]
const float kStep = 0.15f;                                      // [mm] 900 mm/min in 10 ms
const float kSag = 6.2f;                                        // [mm] in a lower corner
const float kMoveLength = bench::kMoveTicks * kStep * 0.9999f;  // [mm] rounds up to these ticks

volatile int32_t left, right;
volatile bool failed;
Machine<float> machine;

/// Sag, stretch and pitch as on the default machine.
struct TypicalSizes {
  float* next;

  template <class Own>
  void effect(int first_setting) {
    const bool present = first_setting >= 160 && first_setting <= 180;
    for (uint8_t i = 0; i < Own::kParamCount; ++i)
      *next++ = present ? float(Own::param(i).typical) : 0.0f;
  }
};

void prepareMachine() {
  const Frame<float> frame = {2978.4f,  kMotorHeight, 0.0f,        139.1f,
                              10.1063f, 97.9f,        0.00137293f, Feed::kOverTop};
  EffectParams<float> effects;
  TypicalSizes sizes = {effects.value};
  kinematics::Effects::For<float>::visit(sizes);
  machine = prepare(frame, effects);
}

struct Exactly {
  Lengths<float> operator()(Point<float> place) const {
    const PaidOut<float> paid = inverse(machine, kinematics::Point<float>{place.x, place.y});
    return {paid.chains.left, paid.chains.right, paid.found == Found::kYes};
  }
};

const Exactly exactly;

/// The move that is timed from a place of the grid: inwards and down, or round a circle there.
Path<float> pathFrom(const bench::Case& timed, Point<float> at) {
  const float inwards = at.x > 0 ? -1 : 1;
  if (timed.shape == bench::kLine)
    return motion::line(
        at, Point<float>{at.x + inwards * kMoveLength * 0.8f, at.y - kMoveLength * 0.6f});
  const float radius = timed.radius;
  const float turn = kMoveLength / radius;
  const Point<float> centre = {at.x, at.y};
  const Point<float> from = {at.x + radius, at.y};
  const Point<float> to = {at.x + radius * float(cos(turn)), at.y + radius * float(sin(turn))};
  return motion::arc(from, to, centre, motion::Turn::kCounterclockwise);
}

motion::Surroundings<float> around(const Path<float>& path) {
  const float to_left = clearance(path, Point<float>{-kHalfGap, kMotorHeight});
  const float to_right = clearance(path, Point<float>{kHalfGap, kMotorHeight});
  return {to_left < to_right ? to_left : to_right,
          motion::sagSlopes(kSag, kHalfGap + kHalfWidth, kHalfGap - kHalfWidth,
                            kMotorHeight + kHalfHeight, 3186.0f)};
}

/// One tick as the firmware would have it: the set-points are moved on and told.
void tick(PathFollower<float>& follower) {
  if (follower.tick(exactly) != Outcome::kMoving) failed = true;
  const Knot now = follower.setPoints();
  left = now.left;
  right = now.right;
}

/// Sleeps with interrupts off: the simulator reports it.
void giveUp() {
  sleep_enable();
  sleep_cpu();
}

void mark(uint8_t number) {
  BARRIER();
  GPIOR0 = number;
  BARRIER();
}

void timeOne(uint8_t number, Point<float> at) {
  const bench::Case& timed = bench::kCases[number];
  const Path<float> path = pathFrom(timed, at);
  PathFollower<float> follower(knotAt(exactly, path.from).knot);
  const motion::Surroundings<float> surroundings = around(path);
  if (timed.what == bench::kNothing) {
    mark(number + 1);
    mark(0);
  } else if (timed.what == bench::kTick) {
    failed = follower.follow(path, kStep, surroundings) != Outcome::kMoving;
    for (uint8_t i = 0; i < 200; ++i) {
      mark(number + 1);
      tick(follower);
      mark(0);
    }
  } else {
    mark(number + 1);
    failed = follower.follow(path, kStep, surroundings) != Outcome::kMoving;
    for (uint16_t i = 0; i < timed.ticks; ++i) tick(follower);
    mark(0);
  }
}

}  // namespace

int main() {
  prepareMachine();
  for (uint8_t i = 0; i < bench::kCaseCount; ++i)
    for (uint8_t column = 0; column < bench::kColumns; ++column)
      for (uint8_t row = 0; row < bench::kRows; ++row) {
        timeOne(i, {-1100.0f + 2200.0f * column / (bench::kColumns - 1),
                    -500.0f + 1000.0f * row / (bench::kRows - 1)});
        if (failed) giveUp();
      }
  GPIOR0 = bench::kFinished;
  for (;;) {
  }
}
