// Names may be longer than 40 characters.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A_name_that_is_longer_than_forty_characters_and_ends_in_1 = 0.5;
#declare A_name_that_is_longer_than_forty_characters_and_ends_in_2 = 0.9;
sphere { -1.5*x, A_name_that_is_longer_than_forty_characters_and_ends_in_1 }
sphere { 1.5*x, A_name_that_is_longer_than_forty_characters_and_ends_in_2 }
