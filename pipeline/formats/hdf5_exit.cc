#include "pipeline/formats/hdf5_exit.h"

#include <hdf5.h>

namespace blocklift::pipeline {

void leave_no_files_to_hdf5() { H5dont_atexit(); }

}  // namespace blocklift::pipeline
