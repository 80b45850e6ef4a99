// Short ways to read a line in a test.
#pragma once

#include <GCode.h>

#include <string>
#include <vector>

/// A line without its comments and spaces.
inline std::string cleaned(std::string line) {
  line.push_back('\0');
  gcode::clean(&line[0]);
  return line.c_str();
}

/// The pieces of a line as it came.
inline std::vector<gcode::Piece> piecesOf(const std::string& line) {
  const std::string text = cleaned(line);
  gcode::Pieces pieces(text.c_str());
  std::vector<gcode::Piece> all;
  gcode::Piece piece;
  while (pieces.next(piece)) all.push_back(piece);
  return all;
}

inline gcode::Fault faultOf(const std::string& line) {
  return gcode::findMistake(cleaned(line).c_str()).fault;
}

/// The number behind a letter in a line of one piece.
inline float valueIn(const std::string& line, char letter) {
  return piecesOf(line).at(0).words.value(letter);
}

/// The codes of a line, `G38.2 M2`.
inline std::string codesOf(const std::string& line) {
  std::string codes;
  for (const gcode::Piece& piece : piecesOf(line)) {
    if (!codes.empty()) codes += ' ';
    if (piece.letter == gcode::kNoLetter) {
      codes += '-';
      continue;
    }
    codes += piece.letter + std::to_string(piece.tenths / 10);
    if (piece.tenths % 10 != 0) codes += '.' + std::to_string(piece.tenths % 10);
  }
  return codes;
}
