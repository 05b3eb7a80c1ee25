// SPDX-License-Identifier: MIT
// Expectations: comparisons of numbers that decide a claim.
//
//   RUN.METRIC[@REGION+...] OPERATOR [FACTOR *] RUN.METRIC[@REGION+...]
//   RUN.METRIC[@REGION+...] OPERATOR NUMBER
//
// OPERATOR is <, <=, > or >=. Spaces separate all words: "a.noise@flat > 1.5 * b.noise".
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
  std::string quantity() const;  // "noise@flat"; "noise" for the region "all"
};

struct Expectation {
  std::string text;  // as written in the file
  Term left;
  std::string op;
  double factor = 1;          // multiplies the right-hand term; without a term, the number itself
  std::optional<Term> right;  // none: compares with the number `factor`
};

// Throws kUsage if the text does not have this form, or names an unknown metric or region.
Expectation parseExpectation(const std::string& text);

// Whether the expectation holds, with `value` for the terms' values. False if a value is NaN.
bool holds(const Expectation& expectation, const std::function<double(const Term&)>& value);

}  // namespace grisaille::lab::claims
