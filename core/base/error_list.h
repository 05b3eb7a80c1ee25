// SPDX-License-Identifier: MIT
// The list of all errors: GRISAILLE_ERROR(name, number, remedy). Numbers are never reused.
// 1xxx the GPU layer, 2xxx scenes and cameras, 3xxx effects and plugins, 4xxx images and files,
// 5xxx the command line and settings.
// No include guard: a file that includes this list first defines GRISAILLE_ERROR.

// --- 10xx: a device and its backend
GRISAILLE_ERROR(kBackendMissing, 1001, "install its driver library or choose another --backend")
GRISAILLE_ERROR(kBackendUnknown, 1002, "choose opengl or vulkan")
GRISAILLE_ERROR(kNoDevice, 1003, "see `grisaille backends` for the list of devices")
GRISAILLE_ERROR(kDeviceTooOld, 1004, "update the driver or choose another --device or --backend")
GRISAILLE_ERROR(kDeviceFailed, 1005, "report it with the line above, or try the other --backend")
GRISAILLE_ERROR(kDeviceLost, 1006, "start again; lower the size or the settings if it repeats")
GRISAILLE_ERROR(kOutOfDeviceMemory, 1007, "use a smaller --size or close other programs")
GRISAILLE_ERROR(kShaderRefused, 1008,
                "report it with the driver's name, or try the other --backend")
GRISAILLE_ERROR(kDriverMessages, 1009, "report them; the program should not cause any")
GRISAILLE_ERROR(kNoWindow, 1010, "create the device with a window")
// --- 11xx: descriptors
GRISAILLE_ERROR(kStaleHandle, 1101, "do not use a resource after destroying it")
GRISAILLE_ERROR(kTooManyResources, 1102, "destroy resources that are no longer used")
GRISAILLE_ERROR(kBufferSize, 1103, "give a size from 1 byte to the device's limit")
GRISAILLE_ERROR(kBufferUsage, 1104,
                "name at least one usage, and bind a buffer only for its usages")
GRISAILLE_ERROR(kTextureSize, 1105, "give sizes from 1 to the device's limit")
GRISAILLE_ERROR(kTextureMips, 1106, "give 1 to floor(log2(largest side)) + 1 levels")
GRISAILLE_ERROR(kTextureFormat, 1107, "choose a format that allows the usage")
GRISAILLE_ERROR(kTextureUsage, 1108,
                "name at least one usage, and bind a texture only for its usages")
GRISAILLE_ERROR(kShaderMissing, 1109, "give a compiled shader of the right stage")
GRISAILLE_ERROR(kSpecialization, 1110, "set only constants that the shader declares, each once")
GRISAILLE_ERROR(kPipelineTargets, 1111, "match the target formats of pipeline and render call")
GRISAILLE_ERROR(kVertexLayout, 1112, "feed every vertex input of the shader from a declared stream")
// --- 12xx: recording
GRISAILLE_ERROR(kNotRecording, 1201, "record between begin() and submit()")
GRISAILLE_ERROR(kAlreadyRecording, 1202, "submit() the frame before the next begin()")
GRISAILLE_ERROR(kPassNesting, 1203, "end one pass before the next, and all before submit()")
GRISAILLE_ERROR(kPassMissing, 1204, "record work between beginPass() and endPass()")
GRISAILLE_ERROR(kBindingMissing, 1205, "bind every slot that the shader reads or writes")
GRISAILLE_ERROR(kBindingUnknown, 1206, "bind only slots that the shader declares, each once")
GRISAILLE_ERROR(kBindingRange, 1207,
                "bind a range inside the resource, aligned as the device requires")
GRISAILLE_ERROR(kBindingSmall, 1208, "bind at least as many bytes as the shader's block holds")
GRISAILLE_ERROR(kBindingFormat, 1209, "bind an image of the format that the shader declares")
GRISAILLE_ERROR(kHazard, 1210, "do not read and write one subresource in the same call")
GRISAILLE_ERROR(kUninitialised, 1211, "write a resource before it is read")
GRISAILLE_ERROR(kDispatchSize, 1212, "dispatch 1 to the device's limit of groups on each axis")
GRISAILLE_ERROR(kTargetMismatch, 1213, "give targets of one size, at least one")
GRISAILLE_ERROR(kDrawRange, 1214, "draw only indices and vertices that the buffers hold")
GRISAILLE_ERROR(kUploadRange, 1215, "upload exactly the bytes of a range inside the resource")
GRISAILLE_ERROR(kTransientStale, 1216, "use a transient texture only in the frame that created it")
GRISAILLE_ERROR(kReadbackRange, 1217, "read a subresource or range that exists")
GRISAILLE_ERROR(kLeaked, 1218, "destroy every resource before its device")
GRISAILLE_ERROR(kUniformSize, 1219, "give 1 to 65536 bytes")
GRISAILLE_ERROR(kDestroyedInUse, 1220, "destroy before the frame uses it or after submit()")
GRISAILLE_ERROR(kScissor, 1221, "give a rectangle inside the targets, or none for all of them")
// --- 21xx: scenes
GRISAILLE_ERROR(kSceneUnreadable, 2101, "check the path and that the file is a whole glTF 2.0 file")
GRISAILLE_ERROR(kSceneInvalid, 2102, "repair the file, for example by exporting it again")
GRISAILLE_ERROR(kSceneExtension, 2103, "export the scene without this extension")
GRISAILLE_ERROR(kSceneEmpty, 2104, "give a scene with at least one triangle")
GRISAILLE_ERROR(kSceneTooLarge, 2105, "give a scene within the limits that the message names")
GRISAILLE_ERROR(kSceneImage, 2106, "replace the image by a PNG, JPEG or WebP that opens elsewhere")
GRISAILLE_ERROR(kSceneAnimation, 2107,
                "see its animations and their durations with `grisaille scene FILE`")
// --- 22xx: cameras
GRISAILLE_ERROR(kCameraUnreadable, 2201, "check the path and that the file is JSON")
GRISAILLE_ERROR(kCameraInvalid, 2202, "write eye, target, fovy_degrees and optionally up and size")
GRISAILLE_ERROR(kBookmarkName, 2203,
                "give 1 to 200 bytes without slashes, not beginning with a dot")
// --- 31xx: plugins
GRISAILLE_ERROR(kPluginUnloadable, 3101, "give a shared library built for this machine")
GRISAILLE_ERROR(kPluginSymbol, 3102, "export the data symbol `grisaille_plugin`")
GRISAILLE_ERROR(kPluginAbi, 3103, "rebuild the plugin against this program's effect header")
GRISAILLE_ERROR(kPluginTable, 3104,
                "correct the field that the message names in the plugin's table")
GRISAILLE_ERROR(kPluginDuplicate, 3105, "remove one of the two plugins or rename the effect")
GRISAILLE_ERROR(kPluginPath, 3106, "give a folder that exists and can be read")
GRISAILLE_ERROR(kPluginCrashes, 3107,
                "repair the plugin; `grisaille effects --verify FILE` shows what fails")
// --- 32xx: running effects
GRISAILLE_ERROR(kEffectUnknown, 3201, "see `grisaille effects` for the list of effects")
GRISAILLE_ERROR(kEffectCreate, 3202, "leave the effect out of --effects or repair its plugin")
GRISAILLE_ERROR(kEffectRecord, 3203, "leave the effect out of --effects or repair its plugin")
GRISAILLE_ERROR(kEffectTwice, 3204, "name each effect once")
GRISAILLE_ERROR(kEffectTakesNoObjects, 3205,
                "name an active effect whose table declares objects, see `grisaille effects`")
GRISAILLE_ERROR(kEffectFaulty, 3206, "repair the faults that the report above lists")
GRISAILLE_ERROR(kEffectOutput, 3207, "run `grisaille effects --verify FILE` on the effect's plugin")
GRISAILLE_ERROR(kEffectLacks, 3208,
                "give what the message names, run the effect that writes it before this one, or "
                "leave this effect out")
GRISAILLE_ERROR(kEffectDrawsNoPoints, 3209,
                "name an active effect that can tell what it draws on surfaces")
// --- 33xx: parameter values
GRISAILLE_ERROR(kParameterUnknown, 3301, "see `grisaille effects` for the keys")
GRISAILLE_ERROR(kParameterRange, 3302, "give a value inside the range")
GRISAILLE_ERROR(kParameterType, 3303, "give a value of the parameter's type")
GRISAILLE_ERROR(kPresetUnknown, 3311, "see `grisaille effects` for an effect's presets")
GRISAILLE_ERROR(kPresetFile, 3312, "create the file again with `grisaille measure --presets`")
// --- 34xx: objects that users make
GRISAILLE_ERROR(kObjectField, 3401, "give a field of the effect's table a value inside its range")
GRISAILLE_ERROR(kObjectIndex, 3402, "name an object of the list, counted from 0")
GRISAILLE_ERROR(kObjectFileUnreadable, 3411, "check the path and that the file may be read")
GRISAILLE_ERROR(kObjectFileInvalid, 3412,
                "correct the place that the message names or save the objects again")
GRISAILLE_ERROR(kObjectFileVersion, 3413, "save the objects again, in a version that can be read")
GRISAILLE_ERROR(kObjectFileEnding, 3414, "end the name in .json")
// --- 41xx: images and files
GRISAILLE_ERROR(kImageUnreadable, 4101, "check the path and that the file is an image")
GRISAILLE_ERROR(kImageFormat, 4102, "end the name in .exr or .png")
GRISAILLE_ERROR(kFileUnwritable, 4103, "check that the folder exists, is writable and has room")
GRISAILLE_ERROR(kImageMismatch, 4104, "compare images of the same size and channels")
GRISAILLE_ERROR(kNoCodecs, 4105,
                "install lib/grisaille beside the program's folder, and OpenImageIO")
// --- 51xx: the command line and settings
GRISAILLE_ERROR(kUsage, 5101, "see --help")
GRISAILLE_ERROR(kOutputUnknown, 5102, "name an output of the frame or of an active effect")
GRISAILLE_ERROR(kSettingsUnreadable, 5103, "check the path and that the file is TOML")
GRISAILLE_ERROR(kSettingsInvalid, 5104, "correct the line that the message names")
GRISAILLE_ERROR(kViewerState, 5105, "no action needed; the viewer starts with its defaults")
GRISAILLE_ERROR(kTruthUnknown, 5106, "name ao, ao_error, ceiling, ceiling_error, depth or normal")
GRISAILLE_ERROR(kTruthCache, 5107, "remove the file; the program traces the truth again")
GRISAILLE_ERROR(kSessionFile, 5109, "give a whole file that the viewer's \"Save session\" wrote")
GRISAILLE_ERROR(kLeftOut, 5108, "build the program again with the option that the message names")
// --- 52xx: the viewer
GRISAILLE_ERROR(kNoDisplay, 5201, "start it on a desktop, or use `grisaille render`")
GRISAILLE_ERROR(kWindowFailed, 5202, "update the driver or choose another --backend")
GRISAILLE_ERROR(kFileUnknown, 5203, "give a .glb, .gltf, .toml or .json file")
// --- 53xx: studies
GRISAILLE_ERROR(kStudyRecord, 5301, "remove the file; the program measures again")
GRISAILLE_ERROR(kFrontSmall, 5302, "measure a grid whose settings differ in cost and in error")
GRISAILLE_ERROR(kTuneImpossible, 5303,
                "allow more, --vary more parameters or a larger --evaluations")
GRISAILLE_ERROR(kUnstable, 5304, "see the cases in bold in the table in --out")
GRISAILLE_ERROR(kNothingToSee, 5305,
                "give cameras that see occluders (--camera, --validate), a larger --radius, or "
                "--random 0")
GRISAILLE_ERROR(kSoakFault, 5306,
                "run it again with the same --seed; the lines above name the faults")
// --- 54xx: new effects
GRISAILLE_ERROR(kProjectName, 5401, "give 1 to 40 of a-z, 0-9 and _, beginning with a letter")
GRISAILLE_ERROR(kProjectFolder, 5402, "name a folder that is empty or does not exist")
// --- 55xx: pictures of other renderers
GRISAILLE_ERROR(kPictureCamera, 5501,
                "give --camera FILE, or a depth that holds worldToCamera and worldToNDC")
GRISAILLE_ERROR(kPictureMatrices, 5502, "give --camera FILE instead of the picture's own matrices")
GRISAILLE_ERROR(kPictureSize, 5503, "give whole pictures, all of one size")
GRISAILLE_ERROR(kPictureDepth, 5504, "repair the picture, or name another --depth-kind")
GRISAILLE_ERROR(kPictureChannels, 5505,
                "name the channels with --depth-channel or --normal-channels")
GRISAILLE_ERROR(
    kPictureMissing, 5506,
    "give the picture that the message names, or leave out the effect or output that reads it")
GRISAILLE_ERROR(kPictureDeep, 5508,
                "flatten the picture, for example with `oiiotool DEEP.exr --flatten -o FLAT.exr`")
GRISAILLE_ERROR(kPictureNormal, 5509,
                "give normals of length 1 that face the camera; --normal-space, --normal-encoding "
                "and --normal-channels say how they are stored")
GRISAILLE_ERROR(kPictureAspect, 5510, "resample the picture to square pixels")
GRISAILLE_ERROR(kPictureColour, 5511, "repair the picture: base colours are linear, from 0 to 1")
GRISAILLE_ERROR(kPictureThickness, 5512,
                "repair the picture: thickness is in metres, 0 for sheets, below 0 where unknown")
GRISAILLE_ERROR(kSequence, 5507, "number the files with %04d or ####, the same frames in each")
GRISAILLE_ERROR(kVideo, 5513,
                "install ffmpeg, or give a name with an ending that it knows, such as .mp4; the "
                "numbered pictures are kept")
// --- 56xx: libgrisaille
GRISAILLE_ERROR(kHostNull, 5601, "pass a pointer that is not null")
GRISAILLE_ERROR(kHostStruct, 5602,
                "set struct_size to sizeof the struct, and fields of later versions to 0")
GRISAILLE_ERROR(kHostDevice, 5603,
                "give the handles of one device that meets the requirements in host.h")
GRISAILLE_ERROR(kHostContext, 5604, "make the device's OpenGL context current")
GRISAILLE_ERROR(kHostTexture, 5605, "describe a 2D texture of one sample that shaders can sample")
GRISAILLE_ERROR(kHostFrame, 5606,
                "count frames upwards; pass a command buffer with Vulkan, null with OpenGL")
GRISAILLE_ERROR(kHostCamera, 5607,
                "give matrices as the comment of grisaille_host_camera describes them")
GRISAILLE_ERROR(kHostInUse, 5608, "destroy textures and effects before their device")
GRISAILLE_ERROR(kHostForeign, 5609, "use only objects of one device together")
GRISAILLE_ERROR(
    kHostMissing, 5610,
    "give the texture that the message names, or choose outputs and parameters that do not read it")
GRISAILLE_ERROR(kHostValue, 5611, "give one of the values that the header lists")
// --- 90xx: the program itself
GRISAILLE_ERROR(kUnexpected, 9001, "report it with the command that led here")
GRISAILLE_ERROR(kOutOfMemory, 9002, "use a smaller --size or scene, or close other programs")
