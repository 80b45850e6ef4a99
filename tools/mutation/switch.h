// The switch of mutants: included before every file of a mutated build.
#pragma once

#include <stddef.h>

namespace mutation {

enum : unsigned { kMostMutants = 20000 };

/// The mutant that lives in this run; 0: none. From the environment, PLUMB_MUTANT.
extern unsigned alive;
/// What was asked since the last test ended.
extern unsigned char reached[kMostMutants];
/// What was asked for a static variable of a function: all tests from then on live with the answer.
extern unsigned char kept[kMostMutants];

/// Whether mutant `number` lives; a question also says that it was reached.
inline bool isAlive(unsigned number) {
  reached[number] = 1;
  return number == alive;
}

/// The same where the answer is kept until the program ends.
inline bool isAliveForGood(unsigned number) {
  kept[number] = 1;
  return number == alive;
}

}  // namespace mutation

#define MUTANT(number) ::mutation::isAlive(number)
#define MUTANT_KEPT(number) ::mutation::isAliveForGood(number)
