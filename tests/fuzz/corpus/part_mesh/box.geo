SetFactory("OpenCASCADE"); // a box
Box(1) = {0, 0, 0, 1, 2, 3};
Printf("size %g", 1); /* > */
Physical Volume("box") = {1};
