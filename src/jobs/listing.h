#pragma once

#include <string>
#include <vector>

#include "io/json_text.h"
#include "jobs/config.h"
#include "jobs/expectation.h"
#include "jobs/plan.h"

namespace gramloom {

// Tables for `gramloom list` and `gramloom check`.

/// Every method: summary, then each parameter with its default, what is allowed and its meaning.
std::string list_methods();
/// What each method can be asked beyond a texture of some size, as the table in docs/directing.md.
std::string list_abilities();
/// The sections of a config that direct its textures, with their keys.
std::string list_direction();
/// The same of every procedural texture.
std::string list_patterns();
/// The network descriptions of the models folder, by the name that a config uses.
std::string list_networks();
std::vector<std::string> network_names();
/// What a model to train has, and the trained models of the models folder.
std::string list_models();

/// The same lists for programs; those of key lists follow from jobs/key_lists.h.
Json abilities_json();
Json networks_json();
Json models_json();
Json metrics_json();

/// The selected jobs with their estimated memory and time, and what keeps one from running.
std::string job_table(const Config& config, const Plan& plan);
/// The models to train, likewise.
std::string lesson_table(const std::vector<Expectation>& lessons);
/// The same for programs, in bytes and seconds.
Json jobs_json(const Config& config, const Plan& plan);

/// What is made of a height map or a photograph, with its parameters.
std::string list_maps();

/// What a simulation of a sleeve is told.
std::string list_simulation();

/// Every score with its meaning, its range and what fools it.
std::string list_metrics();

}  // namespace gramloom
