#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace blocklift::structure {

/// Is the file a universal file of I-DEAS by its ending (.unv)?
bool is_universal_file(const std::string& path);

/// Reads the mesh of a universal file, which I-DEAS, NX, Salome and Gmsh write, into Gmsh's current
/// model: nodes (datasets 15, 781, 2411), elements (2412: bars, plates and solids of order 1 and 2)
/// and groups (2429 to 2477). Other datasets are passed over. Elements that are in the same groups
/// are one discrete entity, and each group is a physical group of its name; the numbers of
/// properties and materials that elements carry make no groups. Where a group has elements of
/// several dimensions, those of the largest have its name, the others "NAME (curve)" and so on.
///
/// Coordinates stay as they are: what unit they are in is for the caller to know, since Salome
/// writes metres whatever was drawn.
/// A group of nodes alone that are all nodes of some outer faces of solids is one of these faces.
/// @return other groups of nodes alone, by name: the numbers of their nodes. One of the name of a
///   group of elements is called "NAME nodes".
/// @throws ModelError with the line of the file: what is no number or lacks, kinds of elements that
///   are not known, numbers that are there twice, nodes and elements that do not exist, and
///   coordinates in other systems than the global one.
///
/// Source: Siemens' universal file datasets 2411, 2412 and 2467.
std::map<std::string, std::vector<std::size_t>> open_universal_file(const std::string& path);

}  // namespace blocklift::structure
