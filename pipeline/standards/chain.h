#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// One step of a chain: a load that it begins with or adds, or a factor; by the standard, and as
/// the simulation of this lift gives it.
struct ChainStep {
  enum class Kind {
    load,    ///< begins the chain, or is added to it, N (of a stress, Pa)
    factor,  ///< multiplies it
    result,  ///< what has come out up to here
    told     ///< stands beside the chain and changes nothing
  };
  Kind kind = Kind::factor;
  std::string name;                 ///< "dynamic amplification"
  std::optional<double> standard;   ///< none: the standard has no such step
  std::optional<double> simulated;  ///< none: the simulation has no such step
  std::string unit = "1";           ///< "1", "N", "Pa", "rad"
  std::string clause;               ///< "0027/ND 5.5.1, table 5-1", or the key of the input
  std::string formula;              ///< with its numbers, or a word about it
};

/// The factors of one thing of the lift, step by step, with what it may bear.
struct Chain {
  std::string object;  ///< "sling R1"
  std::string name;    ///< of the thing alone: "R1"
  std::string kind;    ///< "sling"
  std::vector<ChainStep> steps;
  double standard = 0;   ///< the load that the standard's factors make, in `unit`
  double simulated = 0;  ///< the same with the simulation in place of the factors that it covers
  std::string unit = "N";
  std::optional<double> limit;  ///< what it may bear; none: nothing is held against it
  std::string limit_text;       ///< "breaking load / 2.54"
  std::string limit_clause;
  std::optional<double> simulated_limit;  ///< where the simulation changes it, too

  bool has_limit() const { return limit.has_value(); }
  double standard_utilisation() const;   ///< 0 without a limit
  double simulated_utilisation() const;  ///< 0 without a limit
  double utilisation() const;            ///< the larger of the two
};

/// Works a chain in both columns.
class ChainBuilder {
 public:
  ChainBuilder(std::string kind, std::string name, std::string unit = "N");

  /// A load that begins the chain or is added to it, alike in both columns.
  ChainBuilder& add(std::string name, double load, std::string clause, std::string formula = {});
  /// A load that begins the chain, one in each column.
  ChainBuilder& begin(std::string name, double standard, double simulated, std::string clause,
                      std::string formula = {});
  /// A factor, by the standard and by the simulation; none counts as 1.
  ChainBuilder& times(std::string name, std::optional<double> standard,
                      std::optional<double> simulated, std::string clause,
                      std::string formula = {});
  /// What has come out up to here.
  ChainBuilder& result(std::string name, std::string clause = {});
  /// A figure that changes nothing.
  ChainBuilder& tell(ChainStep step);
  ChainBuilder& limit(double limit, std::string text, std::string clause,
                      std::optional<double> simulated = {});

  double standard() const { return chain_.standard; }
  double simulated() const { return chain_.simulated; }
  Chain finish() { return std::move(chain_); }

 private:
  Chain chain_;
};

}  // namespace blocklift::pipeline
