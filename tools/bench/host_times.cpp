// Times the kinematics on this computer, and a fixed loop that shows how fast the computer is.
// One line of JSON: {"multiply-add": nanoseconds, "inverse, double": ..., ...}
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "Kinematics.h"

using namespace kinematics;

namespace {

const int kRounds = 7;  // the fastest round counts: other programs slow the others
const int kPlaces = 20000;
const int kMultiplyAdds = 10000000;

volatile double sink;

/// Mean nanoseconds of `count` calls of `work(i)`, which returns a number.
template <class Work>
double best(int count, Work work) {
  double least = 1e300;
  for (int round = 0; round < kRounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += work(i);
    sink = sum;
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    least = std::min(least, taken.count() / count);
  }
  return least;
}

/// Fills in the typical size of every effect.
template <class Real>
struct TypicalSizes {
  Real* next;

  template <class ThisEffect>
  void effect(int) {
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i)
      *next++ = Real(ThisEffect::param(i).typical);
  }
};

template <class Real>
Machine<Real> machine() {
  const Frame<Real> frame = {Real(2978.4),  Real(1072.6), Real(0),          Real(139.1),
                             Real(10.1063), Real(97.9),   Real(0.00137293), Feed::kOverTop};
  EffectParams<Real> effects;
  TypicalSizes<Real> sizes = {effects.value};
  Effects::For<Real>::visit(sizes);
  return prepare(frame, effects);
}

/// Place number i of a walk over the sheet that does not repeat a place for long.
template <class Real>
Point<Real> place(int i) {
  return {Real(-1200 + i * 37 % 2400), Real(-600 + i * 53 % 1200)};
}

/// A chain of products in which each needs the last, so the compiler can skip none.
double multiplyAdd() {
  volatile double factor = 0.999999, term = 1e-6;
  const double by = factor, more = term;
  double value = 1;
  return best(kMultiplyAdds, [&](int) { return value = value * by + more; });
}

template <class Real>
void print(const char* number) {
  const Machine<Real> machine_now = machine<Real>();
  std::printf(", \"inverse, %s\": %.3f", number, best(kPlaces, [&](int i) {
                return double(inverse(machine_now, place<Real>(i)).chains.left);
              }));
  // Chains of a coarser walk, worked out in advance so that their time does not count.
  Chains<Real> chains[64];
  for (int i = 0; i < 64; ++i) chains[i] = inverse(machine_now, place<Real>(i * 311)).chains;
  std::printf(", \"forward, %s\": %.3f", number, best(kPlaces, [&](int i) {
                return double(forward(machine_now, chains[i % 64]).sled.x);
              }));
}

}  // namespace

int main() {
  std::printf("{\"multiply-add\": %.4f", multiplyAdd());
  print<float>("float");
  print<double>("double");
  std::printf("}\n");
}
