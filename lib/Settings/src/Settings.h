// The library's front door: setting values, their table, and all that survives a power cut.
#pragma once

#include "format.h"
#include "memory.h"
#include "text.h"
#include "values.h"
