#include "pipeline/verification/dynamics/benchmark_reference.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {
namespace {

/// What an output's column can measure.
Format<Quantity> figure_format(Range range = {}) {
  return quantity_of({Dimension::ratio, Dimension::length, Dimension::angle, Dimension::speed,
                      Dimension::angular_speed, Dimension::acceleration,
                      Dimension::angular_acceleration, Dimension::force, Dimension::moment},
                     range);
}

constexpr const char* column_meaning = "column of the output, where it has several";

Format<ReferenceFigure> figures_format() {
  return Table<ReferenceFigure>("figure", "A column of an output at one time, and its reference.")
      .required("output", &ReferenceFigure::output, reference(), "output of the mechanism file")
      .optional("column", &ReferenceFigure::column, text(), column_meaning)
      .required("time", &ReferenceFigure::time, quantity(Dimension::time, Range::not_negative()),
                "a sample of the run")
      .required("value", &ReferenceFigure::value, figure_format(), "the reference")
      .required("tolerance", &ReferenceFigure::tolerance, figure_format(Range::positive()),
                "largest difference that is allowed")
      .optional("source", &ReferenceFigure::source, text(),
                "of this value, where it differs from the benchmark's")
      .rule([](const ReferenceFigure& figure, Reading& reading, const Mark& mark) {
        if (figure.value.dimension == figure.tolerance.dimension) return;
        reading.error(mark, fmt::format("the value is {}, its tolerance {}",
                                        text_of(figure.value.dimension).noun,
                                        text_of(figure.tolerance.dimension).noun));
      })
      .format();
}

Format<ReferenceBound> bounds_format() {
  return Table<ReferenceBound>("bound", "An output that stays small over the whole run.")
      .required("output", &ReferenceBound::output, reference(), "output of the mechanism file")
      .required("largest", &ReferenceBound::largest, number(Range::positive()),
                "largest size of any of its columns, SI")
      .optional("source", &ReferenceBound::source, text(), "why it must vanish")
      .format();
}

Format<ReferenceConvergence> convergence_format() {
  return Table<ReferenceConvergence>("convergence",
                                     "The error of a figure follows the integration's tolerance.")
      .required("output", &ReferenceConvergence::output, reference(),
                "output of one of the figures")
      .optional("column", &ReferenceConvergence::column, text(), column_meaning)
      .required("time", &ReferenceConvergence::time,
                quantity(Dimension::time, Range::not_negative()), "time of that figure")
      .required("tolerances", &ReferenceConvergence::tolerances,
                list_of(number(Range::positive()), 2), "relative tolerances of the runs, falling")
      .required("error_over_tolerance", &ReferenceConvergence::error_over_tolerance,
                number(Range::positive()), "largest error allowed, over the relative tolerance, SI")
      .required("order_within", &ReferenceConvergence::order_within, number(Range::positive()),
                "allowed difference of the order from 1")
      .rule([](const ReferenceConvergence& c, Reading& reading, const Mark& mark) {
        if (!std::is_sorted(c.tolerances.begin(), c.tolerances.end(), std::greater_equal<>()))
          reading.error(mark, "the tolerances must fall from one to the next");
      })
      .format();
}

void check_convergence(const BenchmarkReference& reference, Reading& reading,
                       const Mark& /*mark*/) {
  if (!reference.convergence) return;
  const ReferenceConvergence& c = *reference.convergence;
  const bool known = std::any_of(
      reference.figures.begin(), reference.figures.end(), [&](const ReferenceFigure& figure) {
        return figure.output.value == c.output.value && figure.column == c.column &&
               figure.time.value == c.time.value;
      });
  if (known) return;
  std::vector<std::string> names;
  for (const ReferenceFigure& figure : reference.figures) names.push_back(figure.output.value);
  reading.error(c.output.mark, "convergence: no figure has this output, column and time",
                {names_hint("figures are of", names, c.output.value)});
}

}  // namespace

Format<BenchmarkReference> benchmark_reference_format() {
  return Table<BenchmarkReference>("reference", "What a benchmark's mechanism must give.")
      .required("kind", &BenchmarkReference::kind,
                choice<std::string>({{"reference", "reference"}}), "what this file describes")
      .required("title", &BenchmarkReference::title, text(), "for people")
      .required("source", &BenchmarkReference::source, text(), "where the values come from")
      .required("figures", &BenchmarkReference::figures, list_of(figures_format(), 1),
                "values at given times")
      .optional("bounds", &BenchmarkReference::bounds, list_of(bounds_format()),
                "what stays small throughout")
      .optional("convergence", &BenchmarkReference::convergence, convergence_format(),
                "how the error follows the tolerance")
      .place(&BenchmarkReference::place)
      .rule(check_convergence)
      .format();
}

std::optional<BenchmarkReference> read_benchmark_reference(const std::filesystem::path& file,
                                                           Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  const std::optional<Document> document = load_document(file, diagnostics);
  if (!document) return std::nullopt;
  BenchmarkReference reference;
  Reading reading(*document, diagnostics);
  reading.with_owner("the reference", [&] {
    return benchmark_reference_format().read(document->root, reading, reference);
  });
  reference.file = file;
  if (diagnostics.error_count() > before) return std::nullopt;
  return reference;
}

}  // namespace blocklift::pipeline
