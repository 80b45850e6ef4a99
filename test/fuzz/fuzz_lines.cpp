// Fuzz target: any characters through the ring, as lines, words, pieces and arcs; what the library
// promises is checked on each.
#include <GCode.h>

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "must.h"

using namespace gcode;

namespace {

void checkNumber(const std::string& text) {
  const char* at = text.c_str();
  const Number number = readNumber(at);
  must(at <= text.c_str() + text.size(), "a number goes beyond its line");
  must(std::isfinite(number.value), "a number is not finite");
  if (number.fault != Fault::kNone) return;
  must(at != text.c_str(), "a number of nothing");
  const double exact = std::strtod(std::string(text.c_str(), at).c_str(), nullptr);
  const double off = std::fabs(double(number.value) - exact);
  must(off <= 4e-7 * std::fabs(exact) + 1e-37, "a number is wrong");
}

void checkWords(const char* line) {
  Word word;
  for (const char* at = line; readWord(at, word);) {
    must(at <= line + std::strlen(line), "a word goes beyond its line");
    must(std::isfinite(word.value), "a word's number is not finite");
    if (std::isupper(uint8_t(word.letter))) checkNumber(at);
  }
}

/// Checks that each letter of a piece is in the line, and that there is a code for each G and M.
void checkPieces(const char* line) {
  if (findMistake(line).fault != Fault::kNone) return;
  int codes = 0;
  Piece piece;
  for (Pieces pieces(line); pieces.next(piece);) {
    codes += piece.letter != kNoLetter;
    must(piece.tenths <= 9990, "a code out of range");
    for (char letter = 'A'; letter <= 'Z'; ++letter)
      must(!piece.words.has(letter) || std::strchr(line, letter), "a word from nowhere");
    const ArcCentre centre = centreByRadius(piece.words.value('X'), piece.words.value('Y'),
                                            piece.words.value('R'), piece.tenths == 20);
    // Squares of numbers beyond this are infinite; the machine refuses them long before.
    const bool huge = std::fabs(piece.words.value('X')) + std::fabs(piece.words.value('Y')) +
                          std::fabs(piece.words.value('R')) >
                      1e15f;
    must(huge || (std::isfinite(centre.x) && std::isfinite(centre.y)), "a centre is not finite");
  }
  for (const char* at = line; *at != '\0'; ++at) codes -= *at == 'G' || *at == 'M';
  must(codes == 0, "a code was lost");
}

void takeLines(Input& input) {
  char line[Input::kRoom + 1];
  while (input.takeLine(line)) {
    must(std::strlen(line) <= Input::kRoom, "a line too long");
    clean(line);
    const std::string once = line;
    clean(line);
    // A checksum holds for the line as it came.
    must(once == line || once.find('*') != std::string::npos, "cleaning twice changes a line");
    checkWords(line);
    checkPieces(line);
    findMistake(line, "LR");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  Input input;
  // The first byte sets how seldom lines are taken out, so that the ring fills.
  const std::size_t every = std::size_t(1) + data[0];
  for (std::size_t i = 1; i < size; ++i) {
    const Quick quick = input.put(char(data[i]));
    must(input.room() <= Input::kRoom, "more room than there is");
    if (quick == Quick::kStop || quick == Quick::kReset || quick == Quick::kOverflow) input.clear();
    if (i % every == 0) takeLines(input);
  }
  takeLines(input);
  return 0;
}
