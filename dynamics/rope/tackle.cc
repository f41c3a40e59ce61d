#include "dynamics/rope/tackle.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

void require_tackle(const Tackle& tackle) {
  if (tackle.falls < 1)
    throw ModelError("a tackle has " + std::to_string(tackle.falls) +
                     " falls; one at least is due");
  if (tackle.lead_sheaves < 0)
    throw ModelError("a tackle has " + std::to_string(tackle.lead_sheaves) +
                     " sheaves before its drum; zero or more are due");
  if (!(tackle.sheave_efficiency > 0 && tackle.sheave_efficiency <= 1))
    throw ModelError("the sheaves of a tackle have the efficiency " +
                     std::to_string(tackle.sheave_efficiency) + "; above 0 and at most 1 is due");
}

}  // namespace

TackleShares calc_shares(const Tackle& tackle, TackleMotion motion) {
  require_tackle(tackle);
  const double eta =
      motion == TackleMotion::hoisting ? tackle.sheave_efficiency : 1 / tackle.sheave_efficiency;
  double sum = 0, fall = 1, last = 1;  // falls over the first
  for (int i = 0; i < tackle.falls; ++i) {
    sum += fall;
    last = fall;
    fall *= eta;
  }
  const double lead = std::pow(eta, -tackle.lead_sheaves);
  return {lead / sum, std::max({lead, 1.0, last}) / sum};
}

double calc_efficiency(const Tackle& tackle) {
  return 1 / (tackle.falls * calc_shares(tackle, TackleMotion::hoisting).lead_line);
}

}  // namespace blocklift::dynamics
