#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "core/archive.h"
#include "core/hash.h"
#include "divot/output.h"
#include "output/atomic_file.h"

namespace divot {
namespace core {

template <class Archive, Is<Override> T>
void archive(Archive& a, T& change) {
  a(change.key, change.value);
}
template <class Archive, Is<SceneFile> T>
void archive(Archive& a, T& scene) {
  a(scene.path, scene.overrides, scene.replay);
}
template <class Archive, Is<RunTotals> T>
void archive(Archive& a, T& totals) {
  a(totals.wall_s, totals.substeps_limited, totals.not_finite, totals.interrupted);
}
template <class Archive, Is<Checkpoint> T>
void archive(Archive& a, T& c) {
  a(c.scene, c.totals, c.world, c.files);
}

}  // namespace core

namespace {

// A file starts with these 16 bytes, then its version, the length of the rest and the rest's checksum.
constexpr std::string_view kMagic = "divot checkpoint";
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kHeaderSize = kMagic.size() + sizeof(kVersion) + 2 * sizeof(std::uint64_t);

std::uint64_t checksum(std::string_view bytes) {
  core::Hash hash;
  for (; bytes.size() >= sizeof(std::uint64_t); bytes.remove_prefix(sizeof(std::uint64_t))) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data(), sizeof word);
    hash.add(word);
  }
  for (const char c : bytes) hash.add(std::uint64_t{static_cast<unsigned char>(c)});
  return hash.value();
}

tl::unexpected<Errors> refuse(const std::string& path, std::string problem, std::string expected) {
  return fail({.file = path, .problem = std::move(problem), .expected = std::move(expected)});
}

}  // namespace

Result<void> write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  core::ByteWriter header, body;
  body(checkpoint);
  header(kVersion, std::uint64_t{body.bytes().size()}, checksum(body.bytes()));
  auto file = output::AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(kMagic), file->write(header.bytes()), file->write(body.bytes());
  return file->commit();
}

Result<Checkpoint> read_checkpoint(const std::string& path) {
  std::error_code unreadable;
  const std::uintmax_t size = std::filesystem::file_size(path, unreadable);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (unreadable || !in)
    return refuse(path, "cannot be read: " + std::generic_category().message(errno != 0 ? errno : unreadable.value()),
                  "expected a checkpoint of divot");

  std::string header(std::min<std::uintmax_t>(size, kHeaderSize), '\0');
  in.read(header.data(), static_cast<std::streamsize>(header.size()));
  if (!in || !header.starts_with(kMagic)) return refuse(path, "is no checkpoint", "expected a checkpoint of divot");
  std::uint32_t version = 0;
  std::uint64_t length = 0, sum = 0;
  core::ByteReader fields(std::string_view(header).substr(kMagic.size()));
  fields(version, length, sum);
  if (fields.ok() && version != kVersion)
    return refuse(path, fmt::format("is a checkpoint of version {}", version),
                  fmt::format("this divot reads version {}: run the scene from its start", kVersion));
  if (!fields.ok() || size - kHeaderSize != length)
    return refuse(path, fmt::format("has {} bytes", size),
                  fields.ok() ? fmt::format("its beginning says {}", length + kHeaderSize) : "it was cut short");

  std::string body(length, '\0');
  in.read(body.data(), static_cast<std::streamsize>(body.size()));
  Checkpoint checkpoint;
  core::ByteReader reader(body);
  if (in && checksum(body) == sum) reader(checkpoint);
  if (!in || checksum(body) != sum || !reader.ok() || !reader.at_end())
    return refuse(path, "is damaged: its checksum is not that of what it holds", "use an earlier checkpoint");
  return checkpoint;
}

}  // namespace divot
