// The switch for mutants, included before every file of a mutated build.
#pragma once

#include <stddef.h>

namespace mutation {

enum : unsigned { kMostMutants = 20000 };

/// The mutant that is active in this run; 0: none. From the environment variable PLUMB_MUTANT.
extern unsigned alive;
/// The mutants that were asked for since the last test ended.
extern unsigned char reached[kMostMutants];
/// The mutants asked for by a static variable of a function: the answer holds for all later tests.
extern unsigned char kept[kMostMutants];

/// Whether mutant `number` is active; asking also notes that it was reached.
inline bool isAlive(unsigned number) {
  reached[number] = 1;
  return number == alive;
}

/// Whether mutant `number` is active, where the program keeps the answer until it ends.
inline bool isAliveForGood(unsigned number) {
  kept[number] = 1;
  return number == alive;
}

}  // namespace mutation

#define MUTANT(number) ::mutation::isAlive(number)
#define MUTANT_KEPT(number) ::mutation::isAliveForGood(number)
