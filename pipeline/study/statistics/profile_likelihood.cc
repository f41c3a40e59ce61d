#include "pipeline/study/statistics/profile_likelihood.h"

#include <openturns/DistFunc.hxx>

namespace blocklift::pipeline {

double allowed_loss_of_likelihood(double count) {
  const double student = OT::DistFunc::qStudent(count - 2, 0.975);
  return count / 2 * std::log1p(student * student / (count - 2));
}

}  // namespace blocklift::pipeline
