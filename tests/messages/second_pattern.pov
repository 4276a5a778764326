// mistake in line 3: a second pattern in one pigment
#version 3.7;
sphere { 0, 1 pigment { granite scale 0.5 bozo } }
