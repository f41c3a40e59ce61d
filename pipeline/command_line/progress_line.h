#pragma once

#include <memory>
#include <string>

#include "pipeline/terminal/progress_bar.h"

namespace blocklift::pipeline {

/// Shows each stage of a run in a bar of its own.
class ProgressLine {
 public:
  void show(const std::string& stage, double fraction, const std::string& detail) {
    if (stage != stage_) {
      bar_.reset();
      bar_ = std::make_unique<ProgressBar>(stage);
      stage_ = stage;
    }
    bar_->show(fraction, detail);
  }
  void finish() { bar_.reset(); }

 private:
  std::string stage_;
  std::unique_ptr<ProgressBar> bar_;
};

}  // namespace blocklift::pipeline
