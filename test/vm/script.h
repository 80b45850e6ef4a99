// A dialogue as text: what is sent, what must come back, what the judge is asked.
#pragma once

#include <istream>
#include <stdexcept>
#include <string>
#include <vector>

/// One line of a dialogue.
struct Step {
  enum Kind {
    kSend,       ///< `-> text`: a line with its end
    kSendRaw,    ///< `>> text`: characters alone; ^X is ctrl-X, ^N a line end
    kExpect,     ///< `<- text [within t]`: the next line, reports aside
    kSkipTo,     ///< `<* text [within t]`: some later line; those before are passed over
    kAsk,        ///< `~~ question`: of the simulated machine
  } kind;
  std::string text;
  int line;  ///< where it stands in the file
};

/// The steps of a dialogue; lines that begin with `;` and empty ones are left out.
inline std::vector<Step> readScript(std::istream& text) {
  std::vector<Step> steps;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line[0] == ';') continue;
    const std::string mark = line.substr(0, 2);
    Step step = {Step::kSend, line.size() > 3 ? line.substr(3) : "", number};
    if (mark == ">>")
      step.kind = Step::kSendRaw;
    else if (mark == "<-")
      step.kind = Step::kExpect;
    else if (mark == "<*")
      step.kind = Step::kSkipTo;
    else if (mark == "~~")
      step.kind = Step::kAsk;
    else if (mark != "->")
      throw std::runtime_error("line " + std::to_string(number) + ": begin with -> >> <- <* ~~ ;");
    steps.push_back(step);
  }
  return steps;
}
