// SPDX-License-Identifier: GPL-3.0-or-later
// seaway: the command line client.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "client/commands/commands.hpp"
#include "proto/yaml.hpp"

int main(int argc, char** argv) {
  using namespace seaway::client;
  CLI::App app{"seaway: submits cases to seawayd and shows what comes back", "seaway"};
  app.footer("Exit codes: 0 done, 1 the job or the command failed, 2 wrong usage or case, 3 the job was cancelled,\n"
             "4 the server cannot be reached, 5 no such job or artifact, 6 not allowed.");
  Common common;
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--server", common.server, "host:port or unix:/path")->envname("SEAWAY_SERVER")->capture_default_str();
  app.add_option("--ca", common.credentials.ca, "PEM file of the server's authority: use TLS")->envname("SEAWAY_CA");
  app.add_option("--cert", common.credentials.certificate, "PEM file of our certificate")->envname("SEAWAY_CERT");
  app.add_option("--key", common.credentials.key, "PEM file of its key")->envname("SEAWAY_KEY");
  app.add_option("--token-file", common.token_file, "file with our token")->envname("SEAWAY_TOKEN_FILE");
  app.add_flag("--json", common.json, "machine-readable output");
  app.set_version_flag("--version", std::string(SEAWAY_VERSION));
  add_submit(app, common);
  add_watch(app, common);
  add_jobs(app, common);
  add_job_life(app, common);
  add_results(app, common);
  add_reports(app, common);
  add_sweep(app, common);
  add_plot(app, common);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_usage;
  }
  try {
    if (!common.token_file.empty()) common.credentials.token = read_token(common.token_file);
    JobClient client(common.server, common.credentials);
    return common.run(client);
  } catch (const seaway::yaml::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return exit_usage;
  } catch (const ClientError& error) {
    std::fprintf(stderr, "seaway: %s\n", error.what());
    return error.code();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seaway: %s\n", error.what());
    return exit_failed;
  }
}
