// A program with some parts of the kinematics and nothing else: its size shows what a part adds.
// PARTS, a macro from the command line, is the sum of the wanted parts; 0 is an empty program.
#include <math.h>

#include "Kinematics.h"
#include "reach.h"

using namespace kinematics;

namespace {

enum { kPrepare = 1, kInverse = 2, kForward = 4, kStorage = 8, kReach = 16 };

struct Given {
  const Frame<float>* frame;
  const EffectParams<float>* effects;
  Machine<float>* machine;
  const Point<float>* bit;
  const Chains<float>* chains;
  PaidOut<float>* paid_out;
  Place<float>* place;
  const ReachLimits<float>* limits;
  Reached<float>* reached;
};

// Volatile: the compiler must treat every number as unknown and every result as needed.
volatile float number;
volatile Given given;
Machine<float> storage;

}  // namespace

int main() {
  number = sqrt(number + number * number / number);
  given.machine = 0;
  if (PARTS & kStorage) given.machine = &storage;
  if (PARTS & kPrepare) *given.machine = prepare(*given.frame, *given.effects);
  if (PARTS & kInverse) *given.paid_out = inverse(*given.machine, *given.bit);
  if (PARTS & kForward) *given.place = forward(*given.machine, *given.chains);
  if (PARTS & kReach) *given.reached = reach(*given.machine, *given.bit, *given.limits);
}
