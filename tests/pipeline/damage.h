#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Damage to a file of results, for tests.
namespace blocklift::pipeline::test {

/// Paths of all datasets of an HDF5 file.
std::vector<std::string> datasets_of(const std::filesystem::path& file);

/// Ways to damage a dataset.
enum class Damage { removed, one_number, text, other_shape, not_a_number };
inline constexpr Damage all_damage[] = {Damage::removed, Damage::one_number, Damage::text,
                                        Damage::other_shape, Damage::not_a_number};

/// Damages a dataset; its attributes stay. False, and nothing done, where the way is none for it:
/// text holds no nan.
bool damage(const std::filesystem::path& file, const std::string& dataset, Damage way);

/// Leaves so much of a file, 0 to 1.
void cut(const std::filesystem::path& file, double share);

/// Turns all bits of so many bytes of a file, from a place on, 0 to 1 of its length.
void flip_bytes(const std::filesystem::path& file, double place, int count);

}  // namespace blocklift::pipeline::test
