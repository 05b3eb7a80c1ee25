// SPDX-License-Identifier: MIT
// What most sources include. GrisaillePrecompile.cmake compiles it once; each source still includes
// what it uses, as `./dev lint` checks.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <ranges>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>
