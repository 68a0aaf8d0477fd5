// SPDX-License-Identifier: Apache-2.0
#include "sim/files/image_library.hpp"

#include <utility>

#include "sim/os/shared_library.hpp"

namespace halfway {
namespace {

struct Loaded {
  SharedLibrary library;
  ImageLibrary functions{};
};

Result<Loaded> load() {
  auto library = SharedLibrary::load(HALFWAY_IMAGES);
  if (!library) return library.error();
  Loaded loaded{std::move(*library)};
  if (Status bound =
          loaded.library.bind(loaded.functions.encode_png, "halfway_encode_png", loaded.functions.decode_png,
                              "halfway_decode_png", loaded.functions.versions, "halfway_image_versions");
      !bound)
    return bound.error();
  return loaded;
}

}  // namespace

Result<ImageLibrary> image_library() {
  static const Result<Loaded>& loaded = *new Result<Loaded>(load());
  if (!loaded) return loaded.error();
  return loaded->functions;
}

std::filesystem::path image_library_file() {
  return HALFWAY_IMAGES;
}

}  // namespace halfway
