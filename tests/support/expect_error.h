// SPDX-License-Identifier: MIT
// EXPECT_ERROR(id, statement): expects that the statement throws grisaille::Error with this id.
#pragma once

#include <gtest/gtest.h>

#include "core/base/error.h"

#define EXPECT_ERROR(expected, ...)                                                        \
  do {                                                                                     \
    try {                                                                                  \
      __VA_ARGS__;                                                                         \
      ADD_FAILURE() << "no error was thrown; E" << static_cast<int>(expected)              \
                    << " was expected of " #__VA_ARGS__;                                   \
    } catch (const ::grisaille::Error& error) {                                            \
      EXPECT_EQ(static_cast<int>(error.id()), static_cast<int>(expected)) << error.what(); \
    }                                                                                      \
  } while (false)
