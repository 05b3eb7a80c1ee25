// SPDX-License-Identifier: MIT
// Picks the channels of a picture that hold depth, normal, thickness or colour.
#pragma once

#include <string>

#include "core/image/image.h"

namespace grisaille::app {

// Returns one channel: the one called `name`; if `name` is "", the only channel, else the one
// called Z, else the only one with "depth" in its name. `file`: for messages. Throws
// kPictureChannels with the names of all channels.
image::Image depthChannel(const image::Picture& picture, const std::string& name,
                          const std::string& file);

// Returns three channels, in the order x, y, z: those of `names` ("N.X,N.Y,N.Z"); if `names` is "",
// X, Y, Z or R, G, B of a layer named N or with "normal" in its name, else the first three of a
// picture of three or four channels. Throws as depthChannel() does.
image::Image normalChannels(const image::Picture& picture, const std::string& names,
                            const std::string& file);

// Returns the only channel, else the one with "thickness" in its name. Throws kPictureChannels if
// no single channel is that one.
image::Image thicknessChannel(const image::Picture& picture, const std::string& file);

// Returns the first three channels. Throws kPictureChannels if there are fewer.
image::Image colourChannels(const image::Picture& picture, const std::string& file);

}  // namespace grisaille::app
