// glTF files as text and as bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io_samples.h"

namespace holdfast::samples {

inline std::string base64(const std::string& bytes) {
  constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kAlphabet[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

template <typename T>
std::string packed(const std::vector<T>& values) {
  std::string bytes;
  for (const T value : values) bytes += raw(value, false);
  return bytes;
}

/// The four corners, and then twelve indices of 16 bits.
inline std::string gltf_buffer() {
  return packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         packed<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

constexpr const char* kGltfNumbers =
    R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}])";
constexpr const char* kGltfMeshes =
    R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";
constexpr const char* kGltfScene = R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"n"}])";

inline std::string gltf_json(const std::string& uri, const std::string& scene = kGltfScene,
                             const std::string& meshes = kGltfMeshes,
                             const std::string& numbers = kGltfNumbers) {
  return "{\"asset\":{\"version\":\"2.0\"},\n\"buffers\":[{" +
         (uri.empty() ? "" : "\"uri\":\"" + uri + "\",") + "\"byteLength\":72}],\n" + numbers + ",\n" +
         meshes + ",\n" + scene + "}\n";
}

inline std::string gltf(const std::string& scene = kGltfScene, const std::string& meshes = kGltfMeshes,
                        const std::string& numbers = kGltfNumbers,
                        const std::string& buffer = gltf_buffer()) {
  return gltf_json("data:application/octet-stream;base64," + base64(buffer), scene, meshes, numbers);
}

inline std::string glb(const std::string& json, const std::string& buffer) {
  const auto chunk = [](std::uint32_t type, std::string bytes, char padding) {
    while (bytes.size() % 4 != 0) bytes += padding;
    return raw(static_cast<std::uint32_t>(bytes.size()), false) + raw(type, false) + bytes;
  };
  const std::string chunks = chunk(0x4E4F534A, json, ' ') + chunk(0x004E4942, buffer, '\0');
  return "glTF" + raw(std::uint32_t{2}, false) + raw(static_cast<std::uint32_t>(12 + chunks.size()), false) +
         chunks;
}

}  // namespace holdfast::samples
