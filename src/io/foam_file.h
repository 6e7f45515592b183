// One OpenFOAM file: its header, then text that gzip may pack as it is written.
#pragma once

#include <zlib.h>

#include <charconv>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/atomic_writer.h"
#include "io/labels.h"

namespace holdfast::io {

/// The text of a file, which gzip may pack as it is written.
class FoamFile {
 public:
  FoamFile(const std::filesystem::path& folder, std::string_view object, std::string_view type, bool gzip,
           Watch& watch, const std::string& note = {}, const Labels* labels = nullptr)
      : out_(folder / (std::string(object) + (gzip ? ".gz" : "")), &watch), gzip_(gzip) {
    constexpr int kWindowOfGzip = 15 + 16;
    if (gzip_ && deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kWindowOfGzip, 8,
                              Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::bad_alloc();
    if (labels != nullptr)  // what a reader finds the ids of names by
      for (const auto& [id, name] : labels->names)
        *this << "// " << labels->stem << " " << id << " " << name << "\n";
    *this << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " << type << ";\n";
    if (!note.empty()) *this << "    note        \"" << note << "\";\n";
    *this << "    location    \"constant/polyMesh\";\n    object      " << object << ";\n}\n\n";
  }
  ~FoamFile() {
    if (gzip_) deflateEnd(&stream_);
  }
  FoamFile(FoamFile&&) = delete;

  FoamFile& operator<<(std::string_view text) {
    if (!gzip_) return out_ << text, *this;
    pending_ += text;
    if (pending_.size() > kBlock) deflate_pending(Z_NO_FLUSH);
    return *this;
  }
  template <typename Number>
  requires std::is_arithmetic_v<Number> FoamFile& operator<<(Number value) {
    char digits[40];
    std::to_chars_result result{};
    result = std::to_chars(digits, digits + sizeof digits, value);
    return *this << std::string_view(digits, static_cast<std::size_t>(result.ptr - digits));
  }

  void finish() {
    if (gzip_) {
      deflate_pending(Z_FINISH);
      deflateEnd(&stream_);
      gzip_ = false;
    }
    room_.reset();
    out_.finish();
  }
  void commit() { out_.commit(); }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 16;

  void deflate_pending(int flush) {
    stream_.next_in = reinterpret_cast<Bytef*>(pending_.data());
    stream_.avail_in = static_cast<uInt>(pending_.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(room_.get());
      stream_.avail_out = static_cast<uInt>(kBlock);
      deflate(&stream_, flush);
      out_ << std::string_view(room_.get(), kBlock - stream_.avail_out);
    } while (stream_.avail_out == 0);
    pending_.clear();
  }

  AtomicWriter out_;
  bool gzip_;
  z_stream stream_{};
  std::string pending_;
  std::unique_ptr<char[]> room_ = std::make_unique<char[]>(kBlock);
};

}  // namespace holdfast::io
