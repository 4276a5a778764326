// A scene without anything is a black picture.
#version 3.7;
global_settings { assumed_gamma 1 }
