// SPDX-License-Identifier: MIT
// Finds the cheapest setting under an error, or the most accurate under a cost, in few evaluations:
// a pattern search (Hooke and Jeeves 1961, "'Direct Search' Solution of Numerical and Statistical
// Problems"), which changes one parameter at a time and goes on in a direction that paid. The
// parameter that moves the cost most (kernel size, say) is found first and pays for the others: it
// is moved until the wish is just met, which tells at what rate cost buys error there, and a step
// of another parameter is taken where it buys error cheaper than that.
//
// Why not a grid: with p parameters of v values each, a grid is v^p settings, most of which are
// wrong in every parameter at once. What a search costs grows with the number of parameters, not
// with its power, and a step that the error alone rules out has its cost never measured.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/effect/parameter_name.h"
#include "core/effect/registry.h"

namespace grisaille::app::study {

// One parameter that may change: a column of a point.
struct Axis {
  effect::ParameterName name;
  const grisaille_param_desc* param = nullptr;
};

// A value an axis, in the parameters' own units.
using Point = std::vector<double>;

// One of them is given.
struct Wish {
  double maxError = 0;
  double budget = 0;  // milliseconds
};

struct Evaluated {
  Point point;
  double error = 0;
  double cost = 0;  // milliseconds; 0: never measured
};

// How the search learns of settings. A cost is measured in turns with that of a setting whose cost
// is known, so that what disturbs the machine falls on both.
struct Oracle {
  std::function<double(const Point&)> error;
  std::function<double(const Point&)> cost;
  std::function<double(const Point& point, const Evaluated& known)> costBeside;
  std::function<bool()> stop;  // asked before each evaluation
};

struct Found {
  Evaluated best;
  bool meetsWish = false;
  bool stopped = false;
  size_t starts = 0;      // evaluations of the starting points
  size_t steps = 0;       // further ones
  size_t costsSaved = 0;  // of these, whose cost nobody had to know
};

// Begins at the best of `starts` (at least one) and ends when no step of the smallest size helps,
// or after so many evaluations.
Found search(const std::vector<Axis>& axes, const std::vector<Point>& starts, const Wish& wish,
             const Oracle& oracle, size_t mostEvaluations);

// Whether `a` is what is wished for rather than `b`. One that meets the wish goes before one that
// does not. Under an error, the cheaper, and of two that cost the same within 2 %, a clock's
// repeatability, the more accurate; under a budget, the more accurate. Where neither meets it, the
// one that is nearer to it.
bool isBetter(const Evaluated& a, const Evaluated& b, const Wish& wish);

// The next value of a parameter from `value`, `step` times its usual range up or down (-1, 1): on a
// logarithmic scale where the parameter's is. Whole numbers move by 1 at least. `value` itself
// where there is no further one. Enumerations and switches go to the next or the last one, around.
double stepped(const grisaille_param_desc& param, double value, double step, int direction);

}  // namespace grisaille::app::study
