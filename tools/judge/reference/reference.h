// The judge: where the sled really hangs, by exact statics of elastic catenaries. It shares no
// formula with lib/ and never includes it.
#pragma once

#include "reference/hang.h"
#include "reference/settle.h"
