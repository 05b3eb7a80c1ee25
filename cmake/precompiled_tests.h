// SPDX-License-Identifier: MIT
// As precompiled.h, for the tests.
#include <gtest/gtest.h>

#include "cmake/precompiled.h"
