// Replaces avr-libc's header on the host, where flash is ordinary memory.
#pragma once

#include <stdint.h>
#include <string.h>

#define PROGMEM
#define PSTR(text) (text)
#define pgm_read_byte(at) (*reinterpret_cast<const uint8_t*>(at))
#define pgm_read_ptr(at) (*reinterpret_cast<const void* const*>(at))
#define memcpy_P memcpy
#define strncmp_P strncmp
