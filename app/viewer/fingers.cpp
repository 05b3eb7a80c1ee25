// SPDX-License-Identifier: MIT
#include "app/viewer/fingers.h"

#include <cmath>
#include <utility>

namespace grisaille::app::viewer {

double ScrollAxis::moveTo(double position) {
  const std::optional<double> before = std::exchange(last_, position);
  return before ? (*before - position) / increment_ : 0;
}

double PinchScale::moveTo(double scale) {
  if (!std::isfinite(scale) || scale <= 0) return 1;
  return scale / std::exchange(last_, scale);
}

}  // namespace grisaille::app::viewer
