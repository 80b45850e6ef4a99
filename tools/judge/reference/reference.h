// The judge's front door: where the sled really hangs, by exact statics of elastic catenaries.
// It shares no formula with the laws in lib/ and never includes them.
#pragma once

#include "reference/hang.h"
#include "reference/settle.h"
