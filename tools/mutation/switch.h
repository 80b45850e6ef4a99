// The switch of mutants: included before every file of a mutated build.
#pragma once

#include <stddef.h>

namespace mutation {

enum : unsigned { kMostMutants = 20000 };

/// The mutant that lives in this run; 0: none. From the environment, PLUMB_MUTANT.
extern unsigned alive;
/// What was asked since the last test ended.
extern unsigned char reached[kMostMutants];

/// Whether mutant `number` lives; a question also says that it was reached.
inline bool isAlive(unsigned number) {
  reached[number] = 1;
  return number == alive;
}

}  // namespace mutation

#define MUTANT(number) ::mutation::isAlive(number)
