#![no_main]
libfuzzer_sys::fuzz_target!(|input: &[u8]| povr_fuzz::replies(input));
