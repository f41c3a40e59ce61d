#include "pipeline/processes/slurm_jobs.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "pipeline/formats/atomic_file.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// A word of the shell, whatever letters it has.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char letter : text)
    word += letter == '\'' ? std::string("'\\''") : std::string{letter};
  return word + "'";
}

/// Slurm reads "%" in names of files as the beginning of a number.
std::string without_numbers(std::string path) {
  for (std::size_t at = 0; (at = path.find('%', at)) != std::string::npos; at += 2)
    path.insert(at, 1, '%');
  return path;
}

std::string head_of(const SlurmJobs& jobs, const std::string& name) {
  std::string text = fmt::format(
      "#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={}\n", name,
      jobs.workers);
  for (const std::string& option : jobs.sbatch) text += fmt::format("#SBATCH {}\n", option);
  return text;
}

/// The program where every node sees it, in the folder from which the study's path counts.
std::string call_of(const SlurmJobs& jobs) {
  return fmt::format(
      "cd {} || exit 1\nexec {} sweep {} --workers {}", quoted(fs::current_path().string()),
      quoted(fs::read_symlink("/proc/self/exe").string()), quoted(jobs.study), jobs.workers);
}

void write_script(const fs::path& file, const std::string& text) {
  write_file(file, text);
  fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec, fs::perm_options::add);
}

}  // namespace

fs::path write_slurm_jobs(const SlurmJobs& jobs) {
  const fs::path results = fs::absolute(jobs.folder).lexically_normal();
  const fs::path folder = results / "slurm", parts = results / "parts";
  fs::create_directories(folder);
  write_script(folder / "parts.sh", head_of(jobs, jobs.name) +
                                        fmt::format("#SBATCH --array=1-{}\n", jobs.parts) +
                                        call_of(jobs) +
                                        fmt::format(" --part \"$SLURM_ARRAY_TASK_ID/{}\" --output "
                                                    "{}/\"$SLURM_ARRAY_TASK_ID\" --quiet\n",
                                                    jobs.parts, quoted(parts.string())));
  std::string join = head_of(jobs, jobs.name + "-join") + call_of(jobs);
  for (int part = 1; part <= jobs.parts; ++part)
    join += fmt::format(" \\\n  --join {}/{}", quoted(parts.string()), part);
  write_script(folder / "join.sh",
               join + fmt::format(" \\\n  --output {}\n", quoted(results.string())));
  const auto log = [&](const char* name) {
    return quoted(without_numbers(folder.string()) + "/" + name);
  };
  fs::path submit = folder / "submit.sh";
  write_script(
      submit,
      fmt::format("#!/bin/sh\n"
                  "# Parts that were stopped go on where they stood when this is run again.\n"
                  "set -e\n"
                  "parts=$(sbatch --parsable --output={} {})\n"
                  "parts=${{parts%%;*}}\n"
                  "join=$(sbatch --parsable --dependency=afterok:\"$parts\" "
                  "--kill-on-invalid-dep=yes --output={} {})\n"
                  "echo \"job $parts: {} parts; job ${{join%%;*}}: joins them\"\n",
                  log("part-%a.log"), quoted((folder / "parts.sh").string()), log("join.log"),
                  quoted((folder / "join.sh").string()), jobs.parts));
  return submit;
}

bool is_slurm_here() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / "sbatch").c_str(), X_OK) == 0) return true;
  return false;
}

void submit_slurm_jobs(const fs::path& script) {
  std::fflush(stdout);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread is there yet.
  if (std::system(("/bin/sh " + quoted(script.string())).c_str()) != 0)
    throw std::runtime_error("Slurm did not take the jobs; " + script.string() + " submits them");
}

}  // namespace blocklift::pipeline
