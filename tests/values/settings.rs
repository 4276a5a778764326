//! `global_settings` and versions.

use crate::{agree, refused};

#[test]
fn settings() {
    agree(
        "settings/settings",
        &[
            r#"global_settings{adc_bailout 0.1 ambient_light rgb .5 assumed_gamma 1 charset ascii hf_gray_16 on irid_wavelength rgb <.1,.2,.3> max_intersections 64 max_trace_level 7 mm_per_unit 10 noise_generator 2 number_of_waves 5}
#debug "= ok\n""#,
            r#"global_settings{hf_gray_16 max_trace_level 3}
#debug "= ok\n""#,
            r#"global_settings{hf_gray_16 0}"#,
            r#"global_settings{mm_per_unit 0}"#,
            r#"global_settings{subsurface{samples 50,50 radiosity on}}
#debug "= ok\n""#,
            r#"global_settings{subsurface{samples 50 50 radiosity off}}
#debug "= ok\n""#,
            r#"global_settings{subsurface{}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{count 35,100}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{nearest_count 5,3}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{brightness 1}} global_settings{radiosity{count 10}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{load_file "x"}}"#,
            r#"global_settings{radiosity{save_file "x"}}"#,
            r#"global_settings{radiosity{brightness 2 -1}}
#debug "= ok\n""#,
            r#"global_settings{photons{count 1000}}
#debug "= ok\n""#,
            r#"global_settings{photons{spacing .1}}
#debug "= ok\n""#,
            r#"global_settings{photons{}}
#debug "= ok\n""#,
            r#"global_settings{photons{spacing .1 gather 20,100 media 100 jitter .4 max_trace_level 5 adc_bailout .01 autostop 0 expand_thresholds 0.2,40 radius 0.1}}
#debug "= ok\n""#,
            r#"global_settings{photons{save_file "x" count 100}}
#debug "= ok\n""#,
            r#"global_settings{photons{spacing .1 radius ,2}}"#,
            r#"global_settings{photons{spacing .1 radius}}"#,
            r#"global_settings{max_trace_level 300}"#,
            r#"global_settings{max_trace_level 0}"#,
            r#"global_settings{number_of_waves 0}"#,
            r#"global_settings{assumed_gamma srgb} global_settings{assumed_gamma 2.2}"#,
            r#"global_settings{irid_wavelength .5}"#,
            r#"global_settings{adc_bailout -1}"#,
            r#"global_settings{max_intersections 4.5}"#,
            r#"global_settings{ambient_light red 1}
#debug "= ok\n""#,
            r#"global_settings{#declare A=3; max_trace_level A #if(1) adc_bailout 1 #end}
#debug "= ok\n""#,
            r#"max_trace_level 5"#,
            r#"!#version 3.1;
max_trace_level 5
#debug "= ok\n""#,
        ],
    );
}

#[test]
fn settings_refused() {
    refused(
        "settings/settings_refused",
        &[
            r#"global_settings{max_intersections}"#,
            r#"global_settings{subsurface{samples 50}}
#debug "= ok\n""#,
            r#"global_settings{subsurface on}
#debug "= ok\n""#,
            r#"global_settings{radiosity off}
#debug "= ok\n""#,
            r#"global_settings{radiosity{adc_bailout 0.01 always_sample off brightness 1 count 35 error_bound 1.8 gray_threshold 0 low_error_factor .5 max_sample -1 media off maximum_reuse 0.2 minimum_reuse 0.015 nearest_count 5 normal off pretrace_start .08 pretrace_end .04 recursion_limit 3 subsurface off importance .5}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{count 0}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{recursion_limit 0}}"#,
            r#"global_settings{radiosity{recursion_limit 21}}"#,
            r#"global_settings{radiosity{nearest_count 0}}"#,
            r#"global_settings{radiosity{nearest_count 21}}"#,
            r#"global_settings{radiosity{error_bound 0}}"#,
            r#"global_settings{radiosity{pretrace_start 2}}"#,
            r#"global_settings{radiosity{pretrace_end 0}}"#,
            r#"global_settings{radiosity{low_error_factor 0}}"#,
            r#"global_settings{radiosity{minimum_reuse 0.5 maximum_reuse .2}}"#,
            r#"global_settings{radiosity{gray_threshold 2}}"#,
            r#"global_settings{radiosity{distance_maximum 2}}"#,
            r#"global_settings{radiosity{always_sample}}
#debug "= ok\n""#,
            r#"global_settings{radiosity{media normal}}
#debug "= ok\n""#,
            r#"global_settings{photons{spacing .1 gather 20,100 media 100,2 jitter .4 max_trace_level 5 adc_bailout .01 autostop 0 expand_thresholds 0.2,40 radius 0.1,2,3,4 steps 4}}
#debug "= ok\n""#,
            r#"global_settings{photons{spacing .1 gather 20 }}
#debug "= ok\n""#,
            r#"global_settings{photons{range 3}}"#,
            r#"global_settings{foo 3}"#,
            r#"global_settings{noise_generator 4}"#,
            r#"!global_settings{assumed_gamma 0}"#,
            r#"!global_settings{assumed_gamma -1}"#,
            r#"!global_settings{assumed_gamma 2.2,}"#,
            r#"!global_settings{adc_bailout 1, max_trace_level 3}"#,
        ],
    );
}

#[test]
fn versions() {
    agree(
        "settings/versions",
        &[
            r#"!#version 3.5;
#declare X_Temp=version;
#version 3.1;
#debug concat("= ",str(version,0,3),"\n")
#version X_Temp;
#debug concat("= ",str(version,0,3),"\n")"#,
            r#"!#version version;
#debug concat("= ",str(version,0,3),"\n")"#,
            r#"!#debug concat("= ",str(version,0,3),"\n")
#version 3.7;
#debug concat("= ",str(version,0,3),"\n")"#,
            r#"!#version 3.7
#debug "= ok\n""#,
            r#"!#version 3.7+0;
#debug concat("= ",str(version,0,3),"\n")"#,
            r#"!#version 1.0;
#debug concat("= ",str(version,0,3),"\n")"#,
            r#"!#version 3.5
sphere{0,1}"#,
            r#"#declare A=1;
#version 3.5;
#debug concat("= ",str(version,0,3),"\n")"#,
            r#"sphere{0,1 #version 3.5; pigment{rgb 1}}
#debug concat("= ",str(version,0,3),"\n")"#,
        ],
    );
}

#[test]
fn versions_refused() {
    refused(
        "settings/versions_refused",
        &[
            r#"!#version unofficial megapov 1.0;
#debug "= ok\n""#,
            r#"!#version unofficial patch 3.7;"#,
            r#"!#version 3.9;"#,
        ],
    );
}
