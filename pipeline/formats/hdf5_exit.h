#pragma once

namespace blocklift::pipeline {

/// Keeps HDF5 from its own closing of files at the end of the program, which crashes when a file's
/// last data cannot be written; all files are closed before. To be called before any is opened.
void leave_no_files_to_hdf5();

}  // namespace blocklift::pipeline
