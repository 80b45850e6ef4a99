// How inputs are changed.
#include "mutator.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

const std::size_t kLongest = 2000;

const char* const kWords[] = {"G0 ",
                              "G1 ",
                              "G2 ",
                              "G3 ",
                              "G4 P10",
                              "G10 Z0",
                              "G20\n",
                              "G21\n",
                              "G38.2 Z-5",
                              "G90 ",
                              "G91 ",
                              "G90.1",
                              "G91.1",
                              "M0\n",
                              "M3\n",
                              "M5\n",
                              "T1 M6\n",
                              "M6 T2\n",
                              "X",
                              "Y",
                              "Z",
                              "I",
                              "J",
                              "R",
                              "F",
                              "X10 Y5",
                              "Z-1",
                              "I5 J0",
                              "R-20",
                              "F500",
                              "B01\n",
                              "B02 L1 R0\n",
                              "B04\n",
                              "B05\n",
                              "B06 L1651 R1651\n",
                              "B08\n",
                              "B09 L5 R5\n",
                              "B10 L\n",
                              "B11 S100 T1 L\n",
                              "B13 L1 S5 F10 I2 V2\n",
                              "B14 L1 S1 F5 I2 T100\n",
                              "B15\n",
                              "B16 L1 S10 F20\n",
                              "B17\n",
                              "B18\n",
                              "B19\n",
                              "B20\n",
                              "B99 ON\n",
                              "B99\n",
                              "$$\n",
                              "$\n",
                              "$16=0\n",
                              "$17=1\n",
                              "$7=1\n",
                              "$7=0\n",
                              "$37=1e-5\n",
                              "$62=",
                              "$RST=$\n",
                              "$RST=*\n",
                              "$RST=#\n",
                              "$",
                              "=",
                              "!",
                              "!\n",
                              "~",
                              "~\n",
                              "\x18\n",
                              "`",
                              "(",
                              ")",
                              ";",
                              "%",
                              "/",
                              "\n",
                              "\n\n",
                              "1e99",
                              "1E-05",
                              "--",
                              ".",
                              "-",
                              "nan",
                              "inf",
                              "0.000001",
                              "99999999999",
                              "63.50000000000001",
                              "\x01",
                              "\x02",
                              "\x03",
                              "\x04",
                              "\x05",
                              "\x06",
                              "\x07"};

}  // namespace

Corpus readCorpus(const std::string& folder) {
  std::vector<std::filesystem::path> names;
  for (const auto& file : std::filesystem::directory_iterator(folder)) names.push_back(file.path());
  std::sort(names.begin(), names.end());
  Corpus corpus;
  for (const auto& name : names) {
    std::ifstream file(name, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

Input Mutator::next(const Corpus& corpus) {
  // Half of the time the input is among the newest, which reach new edges most often.
  const std::size_t newest = std::min<std::size_t>(corpus.size(), 20);
  const std::size_t at = below(2) == 0 ? corpus.size() - 1 - below(newest) : below(corpus.size());
  Input input = corpus[at];
  for (std::size_t left = 1 + below(6); left != 0; --left) change(input, corpus);
  if (input.size() > kLongest) input.resize(kLongest);
  return input;
}

void Mutator::change(Input& input, const Corpus& corpus) {
  if (input.empty()) input.push_back(uint8_t(below(256)));
  const std::size_t at = below(input.size());
  switch (below(9)) {
    case 0:
      input[at] = uint8_t(input[at] ^ (1 << below(8)));
      break;
    case 1:
      input[at] = uint8_t(below(256));
      break;
    case 2:
      input[at] = uint8_t("0123456789.-+ E\n"[below(16)]);
      break;
    case 3:
      input.erase(
          input.begin() + long(at),
          input.begin() + long(at + 1 + below(std::min<std::size_t>(8, input.size() - at))));
      break;
    case 4:
    case 5:
      insert(input, kWords[below(sizeof kWords / sizeof kWords[0])]);
      break;
    case 6:
      insert(input, std::to_string(double(int(below(40001)) - 20000) / double(1 + below(100))));
      break;
    case 7:
      splice(input, corpus[below(corpus.size())]);
      break;
    default:
      moveLine(input);
  }
}

void Mutator::insert(Input& input, const std::string& text) {
  input.insert(input.begin() + long(below(input.size() + 1)), text.begin(), text.end());
}

void Mutator::splice(Input& input, const Input& other) {
  const std::size_t from = below(other.size());
  const std::size_t length = below(std::min<std::size_t>(other.size() - from, 200) + 1);
  const Input part(other.begin() + long(from), other.begin() + long(from + length));
  input.insert(input.begin() + long(below(input.size() + 1)), part.begin(), part.end());
}

void Mutator::moveLine(Input& input) {
  const auto start = input.begin() + long(below(input.size()));
  const auto end = std::find(start, input.end(), uint8_t('\n'));
  const Input line(start, end);
  if (below(2) == 0) input.erase(start, end);
  input.insert(input.begin() + long(below(input.size() + 1)), line.begin(), line.end());
}
