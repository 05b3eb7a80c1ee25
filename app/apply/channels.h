// SPDX-License-Identifier: MIT
// Which channels of a picture hold what.
#pragma once

#include <string>

#include "core/image/image.h"

namespace grisaille::app {

// One channel: the named one; else the only one, the one called Z or the only one with "depth" in
// its name. `file` is for messages. Throws kPictureChannels with those that there are.
image::Image depthChannel(const image::Picture& picture, const std::string& name,
                          const std::string& file);

// Three channels, in the order x, y, z: the named ones ("N.X,N.Y,N.Z"); else those that end in X,
// Y, Z of N or of a name with "normal" in it, or the first three of a picture of three or four.
// Throws as depthChannel() does.
image::Image normalChannels(const image::Picture& picture, const std::string& names,
                            const std::string& file);

// The first three of three or more.
image::Image colourChannels(const image::Picture& picture, const std::string& file);

}  // namespace grisaille::app
