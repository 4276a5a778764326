// A scene without a camera has the aspect ratio of the picture, too.
// size: 90x120
#version 3.8;
global_settings { assumed_gamma 1 }
light_source { <5, 8, -6>, 0.8 }
sphere { 4*z, 1 }
sphere { <1, 1, 4>, 0.3 }
