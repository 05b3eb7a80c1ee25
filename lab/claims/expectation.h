// SPDX-License-Identifier: MIT
// What a claim says of its runs, as comparisons of numbers:
//
//   RUN.METRIC[@REGION+...] OPERATOR [FACTOR *] RUN.METRIC[@REGION+...]
//   RUN.METRIC[@REGION+...] OPERATOR NUMBER
//
// with <, <=, > or >= for OPERATOR and a space between all words: "a.noise@flat > 1.5 * b.noise".
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace grisaille::lab::claims {

// A metric of a run in a region.
struct Term {
  std::string run, metric;
  std::string region = "all";

  bool operator==(const Term&) const = default;
  std::string quantity() const;  // "noise@flat", or "noise" for all of the picture
};

struct Expectation {
  std::string text;  // as it was given
  Term left;
  std::string op;
  double factor = 1;          // of the right hand term, or, without one, the number itself
  std::optional<Term> right;  // none: the left hand is compared with a number
};

// Throws Error(kUsage) for what is not of that form or names a metric or a region that there is
// not.
Expectation parseExpectation(const std::string& text);

// With what the terms came to. False where a number is NaN.
bool holds(const Expectation& expectation, const std::function<double(const Term&)>& value);

}  // namespace grisaille::lab::claims
