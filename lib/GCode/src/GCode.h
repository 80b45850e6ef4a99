// The library's front door: turns characters on the wire into G-code words. It moves nothing.
#pragma once

#include "arc_centre.h"
#include "drilling.h"
#include "input.h"
#include "modal.h"
#include "pieces.h"
#include "words.h"
#include "work_offsets.h"
